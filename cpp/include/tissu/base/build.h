#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tissu {

/// What this library was built from.
struct BuildInfo {
  std::string version;
  std::string compiler;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
};

BuildInfo build_info();

}  // namespace tissu
