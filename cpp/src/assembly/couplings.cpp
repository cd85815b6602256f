#include "tissu/assembly/couplings.h"

#include <algorithm>

#include "tissu/base/index.h"

namespace tissu {
namespace {

/// p -> p x arm
Mat3 turning(const Vec3& arm) {
  Mat3 B;
  B << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
  return B;
}

template <class T>
Vec3 value_of(const T* p, std::int32_t row) {
  const T* from = p + 3 * static_cast<std::ptrdiff_t>(row);
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

}  // namespace

void Couplings::clear() {
  for (const std::int32_t row : rows_) place_[at(row)] = -1;
  list_.clear();
  parts_.clear();
  parts_begin_.assign(1, 0);
  rows_.clear();
  row_begin_.clear();
  entries_.clear();
  diagonal_.clear();
}

std::int32_t Couplings::carry(std::span<const CarriedPart> parts) {
  parts_.insert(parts_.end(), parts.begin(), parts.end());
  parts_begin_.push_back(static_cast<std::int32_t>(parts_.size()));
  return kCarried - (static_cast<std::int32_t>(parts_begin_.size()) - 2);
}

void Couplings::add(const Coupling& coupling) { list_.push_back(coupling); }

std::span<const CarriedPart> Couplings::parts(std::int32_t vertex) const {
  const auto first = at(parts_begin_[at(kCarried - vertex)]);
  return std::span(parts_).subspan(first, at(parts_begin_[at(kCarried - vertex) + 1]) - first);
}

/// Calls f(row, coupling, number of the part or -1, coefficient) for every row that a coupling touches.
template <class Function>
void Couplings::for_entries(Function&& f) const {
  for (std::size_t c = 0; c < list_.size(); ++c) {
    for (std::size_t v = 0; v < 4; ++v) {
      const double beta = list_[c].beta[v];
      const std::int32_t vertex = list_[c].vertex[v];
      if (beta == 0.0) continue;
      if (vertex > kCarried) {
        f(vertex, static_cast<std::int32_t>(c), -1, beta);
        continue;
      }
      for (auto i = parts_begin_[at(kCarried - vertex)]; i < parts_begin_[at(kCarried - vertex) + 1]; ++i) {
        f(parts_[at(i)].row, static_cast<std::int32_t>(c), i, beta * parts_[at(i)].weight);
      }
    }
  }
}

void Couplings::close(std::int32_t rows, const std::vector<std::uint8_t>* given) {
  given_ = given;
  lay_rows(rows);
  lay_diagonal();
  sums_.resize(list_.size());
}

void Couplings::lay_rows(std::int32_t rows) {
  place_.resize(at(rows), -1);
  for_entries([&](std::int32_t row, std::int32_t, std::int32_t, double) {
    if (place_[at(row)] >= 0) return;
    place_[at(row)] = 0;
    rows_.push_back(row);
  });
  std::ranges::sort(rows_);
  for (std::size_t i = 0; i < rows_.size(); ++i) place_[at(rows_[i])] = static_cast<std::int32_t>(i);
  row_begin_.assign(rows_.size() + 2, 0);  // one more: counted two ahead, so that it ends up in place
  for_entries(
      [&](std::int32_t row, std::int32_t, std::int32_t, double) { ++row_begin_[at(place_[at(row)]) + 2]; });
  for (std::size_t i = 2; i < row_begin_.size(); ++i) row_begin_[i] += row_begin_[i - 1];
  entries_.resize(at(row_begin_.back()));
  for_entries([&](std::int32_t row, std::int32_t coupling, std::int32_t part, double beta) {
    entries_[at(row_begin_[at(place_[at(row)]) + 1]++)] = {coupling, part, beta};
  });
}

/// Two vertices of a coupling may stand on one row: their shares add up before they are squared.
void Couplings::lay_diagonal() {
  diagonal_.assign(rows_.size(), Mat3::Zero());
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto end = at(row_begin_[r + 1]);
    for (auto e = at(row_begin_[r]); e < end;) {
      const std::int32_t coupling = entries_[e].coupling;
      Mat3 B = Mat3::Zero();
      for (; e < end && entries_[e].coupling == coupling; ++e) B += share(entries_[e], rows_[r]);
      diagonal_[r] += B.transpose() * list_[at(coupling)].H * B;
    }
  }
}

Vec3 Couplings::free(std::int32_t row, Vec3 value) const {
  if (given_ == nullptr) return value;
  const unsigned mask = (*given_)[at(row)];
  for (int k = 0; k < 3; ++k) {
    if (((mask >> k) & 1U) != 0) value[k] = 0.0;
  }
  return value;
}

/// B of an entry, without given axes.
Mat3 Couplings::share(const Entry& entry, std::int32_t row) const {
  const bool turns = entry.part >= 0 && parts_[at(entry.part)].turns;
  Mat3 B = entry.beta * (turns ? turning(parts_[at(entry.part)].arm) : Mat3(Mat3::Identity()));
  const Vec3 open = free(row, Vec3::Ones());
  return B * open.asDiagonal();
}

template <class T>
void Couplings::gather(const Threads& threads, const T* p) const {
  threads.for_pieces(static_cast<std::int32_t>(list_.size()), [&](std::int32_t begin, std::int32_t end) {
    for (auto c = at(begin); c < at(end); ++c) {
      const Coupling& coupling = list_[c];
      Vec3 sum = Vec3::Zero();
      for (std::size_t v = 0; v < 4; ++v) {
        const std::int32_t vertex = coupling.vertex[v];
        if (coupling.beta[v] == 0.0) continue;
        if (vertex > kCarried) {
          sum += coupling.beta[v] * free(vertex, value_of(p, vertex));
          continue;
        }
        for (const CarriedPart& part : parts(vertex)) {
          const Vec3 moved = free(part.row, value_of(p, part.row));
          sum += coupling.beta[v] * part.weight * (part.turns ? Vec3(moved.cross(part.arm)) : moved);
        }
      }
      sums_[c] = coupling.H * sum;
    }
  });
}

template <class T>
void Couplings::scatter(std::int32_t begin, std::int32_t end, double factor, T* out) const {
  auto r = static_cast<std::size_t>(std::ranges::lower_bound(rows_, begin) - rows_.begin());
  for (; r < rows_.size() && rows_[r] < end; ++r) {
    Vec3 sum = Vec3::Zero();
    for (auto e = at(row_begin_[r]); e < at(row_begin_[r + 1]); ++e) {
      const Entry& entry = entries_[e];
      const Vec3& s = sums_[at(entry.coupling)];
      const bool turns = entry.part >= 0 && parts_[at(entry.part)].turns;
      sum += entry.beta * (turns ? Vec3(parts_[at(entry.part)].arm.cross(s)) : s);
    }
    sum = factor * free(rows_[r], sum);
    T* to = out + 3 * static_cast<std::ptrdiff_t>(rows_[r]);
    for (int k = 0; k < 3; ++k) to[k] += static_cast<T>(sum[k]);
  }
}

template <class T>
void Couplings::add_product(const Threads& threads, double factor, const T* p, T* out) const {
  gather(threads, p);
  const auto rows = static_cast<std::int32_t>(place_.size());
  threads.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) { scatter(begin, end, factor, out); });
}

std::int32_t Couplings::place(std::int32_t row) const { return place_[at(row)]; }

void Couplings::add_diagonal(Reals blocks) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    Eigen::Map<Mat3>(blocks.data() + 9 * static_cast<std::ptrdiff_t>(rows_[r])) += diagonal_[r];
  }
}

std::span<const Couplings::Term> Couplings::terms(std::size_t coupling) const {
  terms_.clear();
  const auto add = [&](std::int32_t row, const Mat3& B) {
    const auto found = std::ranges::find(terms_, row, &Term::row);
    if (found != terms_.end()) {
      found->B += B;
    } else {
      terms_.push_back({row, B});
    }
  };
  const Coupling& of = list_[coupling];
  for (std::size_t v = 0; v < 4; ++v) {
    if (of.beta[v] == 0.0) continue;
    if (of.vertex[v] > kCarried) {
      add(of.vertex[v], share({0, -1, of.beta[v]}, of.vertex[v]));
      continue;
    }
    const std::int32_t first = parts_begin_[at(kCarried - of.vertex[v])];
    const std::int32_t last = parts_begin_[at(kCarried - of.vertex[v]) + 1];
    for (std::int32_t i = first; i < last; ++i) {
      const CarriedPart& part = parts_[at(i)];
      add(part.row, share({0, i, of.beta[v] * part.weight}, part.row));
    }
  }
  return terms_;
}

void Couplings::keys(std::vector<Key>& sorted) const {
  sorted.clear();
  for (const Coupling& coupling : list_) {
    if (coupling.mild) continue;
    Key key{};
    for (std::size_t v = 0; v < 4; ++v) {
      const std::int32_t vertex = coupling.vertex[v];
      key[v] = -1;
      if (coupling.beta[v] != 0.0) key[v] = vertex > kCarried ? vertex : parts(vertex).front().row;
    }
    sorted.push_back(key);
  }
  std::ranges::sort(sorted);
}

std::size_t Couplings::bytes() const {
  return list_.size() * sizeof(Coupling) + parts_.size() * sizeof(CarriedPart) +
         entries_.size() * sizeof(Entry) + rows_.size() * (sizeof(std::int32_t) + sizeof(Mat3)) +
         sums_.size() * sizeof(Vec3);
}

template void Couplings::gather(const Threads&, const double*) const;
template void Couplings::gather(const Threads&, const float*) const;
template void Couplings::scatter(std::int32_t, std::int32_t, double, double*) const;
template void Couplings::scatter(std::int32_t, std::int32_t, double, float*) const;
template void Couplings::add_product(const Threads&, double, const double*, double*) const;
template void Couplings::add_product(const Threads&, double, const float*, float*) const;

}  // namespace tissu
