#include <algorithm>
#include <numeric>

#include "tissu/model/body_model.h"

namespace tissu {
namespace {

/// Numbers in the body of a model's cells: its own, or those that follow the cells of the models before it.
std::vector<std::int32_t> numbers_of(const BodyModel& model, std::int32_t first) {
  std::vector<std::int32_t> numbers = model.block().cell_numbers;
  if (numbers.empty()) {
    numbers.resize(static_cast<std::size_t>(model.cell_count()));
    std::iota(numbers.begin(), numbers.end(), first);
  }
  return numbers;
}

}  // namespace

std::unique_ptr<BodyModel> edited_model(const std::vector<const BodyModel*>& before,
                                        const ElasticBlock& left) {
  std::int32_t first = 0;
  for (const BodyModel* model : before) {
    const std::vector<std::int32_t> numbers = numbers_of(*model, first);
    first += model->cell_count();
    if (model->block().model.index() != left.model.index() || model->block().element != left.element)
      continue;
    if (left.cell_numbers.empty() || !std::ranges::includes(numbers, left.cell_numbers)) continue;
    std::vector<std::int32_t> removed;
    std::size_t next = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (next < left.cell_numbers.size() && left.cell_numbers[next] == numbers[i]) {
        ++next;
      } else {
        removed.push_back(static_cast<std::int32_t>(i));
      }
    }
    return model->without(left, removed);
  }
  return nullptr;
}

}  // namespace tissu
