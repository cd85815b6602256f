#pragma once

/// Where the time of a step goes: one row for each thing that runs, none for what does not.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tissu {

class Profile {
 public:
  struct Row {
    std::string effect;  ///< what asked for it: elasticity, gravity, …
    std::string stage;   ///< what it did: force, stiffness, solve, …
    std::int64_t calls = 0;
    double seconds = 0.0;
  };

  /// What the linear solver did.
  struct Solves {
    std::int64_t solves = 0;
    std::int64_t iterations = 0;
    std::int64_t preparations = 0;  ///< preconditioners or factors made
    std::int64_t failures = 0;      ///< solves that did not converge
    double residual = 0.0;          ///< the largest, relative to the right-hand side
    double work = 0.0;              ///< in bytes read, or what takes as long (SolveReport)
  };

  /// The longest step after the first, which prepares; that one where there is no other.
  struct Worst {
    std::int64_t step = 0;  ///< from 1 on; 0: no step was taken
    double seconds = 0.0;
    std::vector<double> row_seconds;  ///< of each row that there was
    std::int64_t solves = 0;
    std::int64_t iterations = 0;
    std::int64_t preparations = 0;
  };

  /// The number of the row of an effect's stage; made when it is not there yet.
  std::size_t row(std::string_view effect, std::string_view stage);
  void add(std::size_t row, double seconds, std::int64_t calls = 1) {
    rows_[row].calls += calls;
    rows_[row].seconds += seconds;
  }
  /// Of a step that ends with `add_step`, or is not taken.
  void begin_step();
  void add_step(double seconds);
  void clear();

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  [[nodiscard]] const Solves& solves() const { return solves_; }
  [[nodiscard]] Solves& solves() { return solves_; }
  [[nodiscard]] const Worst& worst() const { return worst_; }
  /// Durations of the latest steps [s], at most kKept, in no order.
  [[nodiscard]] const std::vector<double>& step_seconds() const { return step_seconds_; }

  static constexpr std::size_t kKept = 4096;

 private:
  void keep_worst(double seconds);

  std::vector<Row> rows_;
  Solves solves_;
  Worst worst_;
  std::vector<double> before_;  ///< seconds of each row when the step began
  Solves solves_before_;
  std::vector<double> step_seconds_;
  std::int64_t steps_ = 0;
};

/// Adds the time from its making to its end to one row.
class Timed {
 public:
  Timed(Profile& profile, std::size_t row) : profile_(profile), row_(row), start_(Clock::now()) {}
  ~Timed() { profile_.add(row_, std::chrono::duration<double>(Clock::now() - start_).count()); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Profile& profile_;
  std::size_t row_;
  Clock::time_point start_;
};

}  // namespace tissu
