#pragma once

/// The errors of tissu. Each carries one sentence: what was found, what is accepted, where, what to do.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace tissu {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A mesh that cannot be simulated as it is.
class MeshError : public Error {
 public:
  using Error::Error;
};

/// A number or an array outside what the equations accept.
class ParameterError : public Error {
 public:
  using Error::Error;
};

/// A step gave a value that is not finite. The state is back at the last good step.
class Diverged : public Error {
 public:
  Diverged(const std::string& message, std::string body, std::int32_t element, double time)
      : Error(message), body_(std::move(body)), element_(element), time_(time) {}
  [[nodiscard]] const std::string& body() const { return body_; }
  [[nodiscard]] std::int32_t element() const { return element_; }  ///< cell of the body, -1 when unknown
  [[nodiscard]] double time() const { return time_; }              ///< of the last good step [s]

 private:
  std::string body_;
  std::int32_t element_;
  double time_;
};

}  // namespace tissu
