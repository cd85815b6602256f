#include "tissu/base/profile.h"

namespace tissu {

std::size_t Profile::row(std::string_view effect, std::string_view stage) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].effect == effect && rows_[i].stage == stage) return i;
  }
  rows_.push_back({std::string(effect), std::string(stage)});
  step_seconds_.reserve(kKept);
  return rows_.size() - 1;
}

void Profile::add_step(double seconds) {
  if (step_seconds_.size() < kKept) {
    step_seconds_.push_back(seconds);
  } else {
    step_seconds_[static_cast<std::size_t>(steps_) % kKept] = seconds;
  }
  ++steps_;
}

void Profile::clear() {
  for (Row& row : rows_) {
    row.calls = 0;
    row.seconds = 0.0;
  }
  solves_ = {};
  step_seconds_.clear();
  steps_ = 0;
}

}  // namespace tissu
