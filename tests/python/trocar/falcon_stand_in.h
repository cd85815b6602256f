#ifndef TISSU_FALCON_STAND_IN_H
#define TISSU_FALCON_STAND_IN_H

// A stand-in for the library of the Falcon, written for a test: the names that examples/plugin/falcon.cpp
// uses, and an arm that is there under the number 7 alone. Its force moves it by 1 mm/N.

#include <array>
#include <cstdint>
#include <memory>

namespace libnifalcon {

class FalconFirmware {
 public:
  bool loadFirmware(bool, long, std::uint8_t*) { return true; }
  void setHomingMode(bool on) { homing_ = on; }
  bool isHomed() const { return homing_; }

 private:
  bool homing_ = false;
};

class FalconDevice {
 public:
  template <class Firmware>
  void setFalconFirmware() {
    firmware_ = std::make_shared<Firmware>();
  }
  template <class Kinematic>
  void setFalconKinematic() {
    static_cast<void>(Kinematic());
  }
  bool open(unsigned number) { return number == 7; }
  void close() {}
  bool isFirmwareLoaded() { return false; }
  std::shared_ptr<FalconFirmware> getFalconFirmware() { return firmware_; }
  bool runIOLoop() { return true; }
  std::array<double, 3> getPosition() {
    return {0.01 + 1e-3 * force_[0], 0.02 + 1e-3 * force_[1], 0.11 + 1e-3 * force_[2]};
  }
  void setForce(const std::array<double, 3>& force) { force_ = force; }

 private:
  std::shared_ptr<FalconFirmware> firmware_;
  std::array<double, 3> force_{};
};

class FalconFirmwareNovintSDK : public FalconFirmware {};
class FalconKinematicStamper {};

constexpr long NOVINT_FALCON_NVENT_FIRMWARE_SIZE = 1;
constexpr std::uint8_t NOVINT_FALCON_NVENT_FIRMWARE[1] = {0};

}  // namespace libnifalcon

#endif
