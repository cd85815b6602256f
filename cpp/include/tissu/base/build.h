#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tissu/base/isa.h"

namespace tissu {

/// What this library was built from.
struct BuildInfo {
  std::string version;
  std::string compiler;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
};

BuildInfo build_info();

/// The compiler's flags of the kernels for an instruction set, which a law made at run time takes too.
std::string_view kernel_flags(Isa isa);

}  // namespace tissu
