#ifndef TISSU_HAPTIC_DEVICE_PLUGIN_H
#define TISSU_HAPTIC_DEVICE_PLUGIN_H

/* What a device plug-in has: a shared library with five functions, in C, that includes this header alone.
   Proprietary kits so never enter the build of tissu. All are called by one thread; read and write at the
   rate of the ticks. */

#include <stddef.h>
#include <stdint.h>

#define TISSU_DEVICE_ABI 1

#ifdef __cplusplus
extern "C" {
#endif

/* What a device is. Channels: pitch [rad, N m], roll, own rotation, depth [m, N], grip. */
typedef struct tissu_device_info { /* NOLINT(modernize-use-using): C */
  int32_t axes;                    /* channels with a motor: the first of the five */
  int32_t torque_confirmed;        /* 1: samples say that the last command was taken */
  double count_size[5];            /* position of one count, above 0 for each axis */
  double torque_limit[5];          /* largest torque of each motor */
  double rate;                     /* samples a second [Hz] */
  double delay;                    /* from read to the torque on the joint [s] */
} tissu_device_info;

typedef struct tissu_device_sample { /* NOLINT(modernize-use-using): C */
  int32_t counts[5];
  uint32_t sequence; /* grows by one with each new sample, and wraps */
  int64_t time_ns;   /* by the device's clock */
  uint64_t tag;      /* of the tool; 0: none */
  uint32_t flags;    /* 1 homed, 2 enabled, 4 tool in, 8 fault */
  uint32_t zero;
} tissu_device_sample;

typedef struct tissu_device_command { /* NOLINT(modernize-use-using): C */
  double torque[5];                   /* on the joints, from the motors */
  uint32_t sequence;                  /* of the sample that is answered */
  uint16_t watchdog_ms;               /* motors are cut this long after the last command */
  uint16_t enable;                    /* 0: no power, whatever torque says */
} tissu_device_command;

/* What read and write give. */
enum { TISSU_DEVICE_OK = 0, TISSU_DEVICE_NONE = 1, TISSU_DEVICE_BROKEN = 2, TISSU_DEVICE_GONE = 3 };

#define TISSU_DEVICE_EXPORT __attribute__((visibility("default")))

/* TISSU_DEVICE_ABI of the header that the plug-in was made with. */
TISSU_DEVICE_EXPORT int tissu_device_abi(void);
/* Opens the device that the address names (a text of the plug-in's own; empty: the first) and fills info.
   NULL: it could not be opened, and `why` holds one sentence of at most `size` bytes, a zero at its end. */
TISSU_DEVICE_EXPORT void* tissu_device_open(const char* address, tissu_device_info* info, char* why,
                                            size_t size);
/* The newest sample, within less than a tick. The sample is unchanged where the answer is not
 * TISSU_DEVICE_OK. */
TISSU_DEVICE_EXPORT int tissu_device_read(void* device, tissu_device_sample* sample);
TISSU_DEVICE_EXPORT int tissu_device_write(void* device, const tissu_device_command* command);
/* Switches the motors off and ends. */
TISSU_DEVICE_EXPORT void tissu_device_close(void* device);

#ifdef __cplusplus
}
#endif

#endif
