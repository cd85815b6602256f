// A device plug-in for the Novint Falcon, an arm of three axes, by libnifalcon: it is felt as a trocar whose
// pivot lies 100 mm before the middle of the arm's room. Build it where libnifalcon is installed:
//
//   cmake -S examples/plugin -B build/plugin -DCMAKE_PREFIX_PATH=PREFIX_OF_TISSU && cmake --build
//   build/plugin
//
// The address is the number of the Falcon, from 0. Own rotation has no axis and no motor.

#include <falcon/core/FalconDevice.h>
#include <falcon/firmware/FalconFirmwareNovintSDK.h>
#include <falcon/kinematic/FalconKinematicStamper.h>
#include <falcon/util/FalconFirmwareBinaryNvent.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "tissu/haptic/device_plugin.h"
#include "tissu/haptic/kinematics.h"

namespace {

using tissu::Vec3;
using tissu::haptic::Fulcrum;
using tissu::haptic::Joints;

constexpr double kPivot = 0.1;     // from the pivot to the middle of the arm's room [m]
constexpr double kMiddle = 0.125;  // its middle along the Falcon's z [m]
constexpr double kTurn = 1.7453292519943296e-4, kSlide = 2e-5;  // counts [rad], [m]: finer than the arm's own

struct Arm {
  libnifalcon::FalconDevice falcon;
  Fulcrum fulcrum;
  Joints q = Joints(0.0, 0.0, 0.0, kPivot);
  std::uint32_t sequence = 0;
};

/// The Falcon's x is to the right, its y up and its z towards the hand; the port's e_Z goes away from the
/// hand.
Vec3 in_port(const libnifalcon::FalconDevice& falcon) {
  const auto at = const_cast<libnifalcon::FalconDevice&>(falcon).getPosition();
  return {at[0], -at[1], kPivot + kMiddle - at[2]};
}

}  // namespace

int tissu_device_abi() { return TISSU_DEVICE_ABI; }

void* tissu_device_open(const char* address, tissu_device_info* info, char* why, size_t size) {
  auto arm = std::make_unique<Arm>();
  libnifalcon::FalconDevice& falcon = arm->falcon;
  falcon.setFalconFirmware<libnifalcon::FalconFirmwareNovintSDK>();
  falcon.setFalconKinematic<libnifalcon::FalconKinematicStamper>();
  if (!falcon.open(static_cast<unsigned>(std::atoi(address)))) {
    std::snprintf(why, size, "no Falcon has the number '%s'", address);
    return nullptr;
  }
  if (!falcon.isFirmwareLoaded() &&
      !falcon.getFalconFirmware()->loadFirmware(
          true, libnifalcon::NOVINT_FALCON_NVENT_FIRMWARE_SIZE,
          const_cast<std::uint8_t*>(libnifalcon::NOVINT_FALCON_NVENT_FIRMWARE))) {
    std::snprintf(why, size, "its firmware was not taken");
    return nullptr;
  }
  falcon.getFalconFirmware()->setHomingMode(true);
  *info = {};
  info->axes = 4;
  info->rate = 1000.0;
  info->delay = 1e-3;
  for (int k = 0; k < 5; ++k) {
    info->count_size[k] = k == 3 ? kSlide : kTurn;
    info->torque_limit[k] = k == 3 ? 9.0 : 0.9;
  }
  info->torque_limit[2] = info->torque_limit[4] = 0.0;
  return arm.release();
}

int tissu_device_read(void* device, tissu_device_sample* sample) {
  Arm& arm = *static_cast<Arm*>(device);
  if (!arm.falcon.runIOLoop()) return TISSU_DEVICE_NONE;
  arm.q = arm.fulcrum.joints(in_port(arm.falcon));
  *sample = {};
  for (int k = 0; k < 4; ++k) {
    sample->counts[k] = static_cast<std::int32_t>(std::floor(arm.q[k] / (k == 3 ? kSlide : kTurn)));
  }
  sample->sequence = ++arm.sequence;
  sample->time_ns = static_cast<std::int64_t>(arm.sequence) * 1'000'000;
  sample->tag = 1;
  sample->flags = 2 | 4;  // enabled, a tool in
  if (arm.falcon.getFalconFirmware()->isHomed()) sample->flags |= 1;
  return TISSU_DEVICE_OK;
}

int tissu_device_write(void* device, const tissu_device_command* command) {
  Arm& arm = *static_cast<Arm*>(device);
  Joints tau = Joints::Zero();
  for (int k = 0; k < 4 && command->enable != 0; ++k) tau[k] = command->torque[k];
  const Vec3 f = arm.fulcrum.force(arm.q, tau);  // J^-T tau
  auto force = arm.falcon.getPosition();         // of the type that this version of the library takes
  force[0] = f[0];
  force[1] = -f[1];
  force[2] = -f[2];
  arm.falcon.setForce(force);
  return TISSU_DEVICE_OK;
}

void tissu_device_close(void* device) {
  const std::unique_ptr<Arm> arm(static_cast<Arm*>(device));
  arm->falcon.close();
}
