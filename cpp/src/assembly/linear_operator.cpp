#include "tissu/assembly/linear_operator.h"

#include <atomic>

namespace tissu {

std::uint64_t LinearOperator::next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace tissu
