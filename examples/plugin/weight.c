/* A device plug-in that needs no device: a tool in a port that a weight pulls down and motors hold.

   cc -shared -fPIC -I$(python -c "import tissu, pathlib; print(pathlib.Path(tissu.__file__).parent /
   'include')") \ weight.c -o weight.so

   The address is the mass in kilogrammes: "0.2"; empty: 0.1. Its depth follows m r'' = m g + f - b r', one
   millisecond with each read; the other axes do not move. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tissu/haptic/device_plugin.h"

struct weight {
  double mass, depth, speed, force;
  uint32_t sequence;
};

static const double count = 1e-4; /* m */
static struct weight the_only;
static int is_open = 0;

int tissu_device_abi(void) { return TISSU_DEVICE_ABI; }

void* tissu_device_open(const char* address, tissu_device_info* info, char* why, size_t size) {
  const double mass = address[0] == '\0' ? 0.1 : atof(address);
  if (is_open) {
    snprintf(why, size, "another program has it");
    return NULL;
  }
  if (!(mass > 0.0)) {
    snprintf(why, size, "found the mass '%s'; kilogrammes above 0 are accepted", address);
    return NULL;
  }
  memset(info, 0, sizeof *info);
  info->axes = 4;
  info->rate = 1000.0;
  for (int k = 0; k < 5; ++k) info->count_size[k] = k == 3 ? count : 1.745329e-4;
  for (int k = 0; k < 4; ++k) info->torque_limit[k] = 5.0;
  the_only = (struct weight){.mass = mass, .depth = 0.1};
  is_open = 1;
  return &the_only;
}

int tissu_device_read(void* device, tissu_device_sample* sample) {
  struct weight* const w = device;
  const double step = 1e-3, damping = 1.0, gravity = 9.81;
  w->speed += step * (gravity + (w->force - damping * w->speed) / w->mass);
  w->depth += step * w->speed;
  memset(sample, 0, sizeof *sample);
  sample->counts[3] = (int32_t)floor(w->depth / count);
  sample->sequence = ++w->sequence;
  sample->time_ns = (int64_t)w->sequence * 1000000;
  sample->flags = 1 | 2 | 4; /* homed, enabled, a tool in */
  sample->tag = 1;
  return TISSU_DEVICE_OK;
}

int tissu_device_write(void* device, const tissu_device_command* command) {
  struct weight* const w = device;
  w->force = command->enable ? command->torque[3] : 0.0;
  return TISSU_DEVICE_OK;
}

void tissu_device_close(void* device) {
  (void)device;
  is_open = 0;
}
