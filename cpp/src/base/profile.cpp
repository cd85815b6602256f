#include "tissu/base/profile.h"

namespace tissu {

std::size_t Profile::row(std::string_view effect, std::string_view stage) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].effect == effect && rows_[i].stage == stage) return i;
  }
  rows_.push_back({std::string(effect), std::string(stage)});
  step_seconds_.reserve(kKept);
  before_.resize(rows_.size(), 0.0);
  return rows_.size() - 1;
}

void Profile::begin_step() {
  for (std::size_t i = 0; i < rows_.size(); ++i) before_[i] = rows_[i].seconds;
  solves_before_ = solves_;
}

void Profile::add_step(double seconds) {
  if (step_seconds_.size() < kKept) {
    step_seconds_.push_back(seconds);
  } else {
    step_seconds_[static_cast<std::size_t>(steps_) % kKept] = seconds;
  }
  ++steps_;
  if (steps_ <= 2 || seconds > worst_.seconds) keep_worst(seconds);
}

void Profile::keep_worst(double seconds) {
  worst_.step = steps_;
  worst_.seconds = seconds;
  worst_.row_seconds.resize(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) worst_.row_seconds[i] = rows_[i].seconds - before_[i];
  worst_.solves = solves_.solves - solves_before_.solves;
  worst_.iterations = solves_.iterations - solves_before_.iterations;
  worst_.preparations = solves_.preparations - solves_before_.preparations;
}

void Profile::clear() {
  for (Row& row : rows_) {
    row.calls = 0;
    row.seconds = 0.0;
  }
  solves_ = {};
  solves_before_ = {};
  worst_ = {};
  before_.assign(rows_.size(), 0.0);
  step_seconds_.clear();
  steps_ = 0;
}

}  // namespace tissu
