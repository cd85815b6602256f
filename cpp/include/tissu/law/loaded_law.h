#pragma once

/// A law from a shared library, made while the program runs: the same numbers and functions as a law of the
/// library's own tables.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tissu/base/isa.h"
#include "tissu/law/law_info.h"
#include "tissu/law/law_kernels.h"
#include "tissu/law/law_library.h"

namespace tissu {

class LoadedLaw {
 public:
  /// Opens the library at `path`. Refuses, in one sentence, a file that is not a library with a law, one made
  /// for another version of tissu, and one for an instruction set that does not run here.
  explicit LoadedLaw(std::string path);
  LoadedLaw(const LoadedLaw&) = delete;
  LoadedLaw& operator=(const LoadedLaw&) = delete;
  LoadedLaw(LoadedLaw&&) = delete;
  LoadedLaw& operator=(LoadedLaw&&) = delete;
  ~LoadedLaw();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] Isa isa() const { return isa_; }
  [[nodiscard]] const LawInfo& info() const { return info_; }
  /// For a reference dimension, or null when it has none.
  [[nodiscard]] const LawKernels* kernels(int dimension) const;
  /// Constants of parameters. Throws ParameterError with the field, its value and what is accepted.
  void compute(std::span<const double> parameters, std::span<double> constants) const;
  /// Lamé's constants at rest; absent where the law is not isotropic there.
  [[nodiscard]] std::optional<Lame> small_strain(std::span<const double> parameters) const;

 private:
  struct Close {
    void operator()(void* handle) const;
  };

  void open();
  void check() const;
  void read_tables();

  std::string path_;
  std::unique_ptr<void, Close> handle_;
  const LawLibrary* library_ = nullptr;
  Isa isa_ = Isa::baseline;
  std::vector<LawParameter> parameters_;
  std::vector<std::string_view> constants_;
  std::vector<LawKernels> kernels_;
  LawInfo info_{};
};

}  // namespace tissu
