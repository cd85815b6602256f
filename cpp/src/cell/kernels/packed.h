#pragma once

/// The nodes of a chunk in the first-level cache, four doubles each so that one load or store takes a whole
/// node. Gather turns lanes of nodes into a register for each axis; scatter turns them back and adds.

#include "tissu/base/batch.h"
#include "tissu/cell/elastic_kernels.h"

namespace tissu::TISSU_KERNELS {

#if defined(__AVX2__)

TISSU_INLINE void gather_packed(const double* values, const std::uint16_t* place, __m256d& x, __m256d& y,
                                __m256d& z) {
  const double* a = values + place[0];
  const double* b = values + place[1];
  const double* c = values + place[2];
  const double* d = values + place[3];
  const __m256d xy02 = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(a)), _mm_load_pd(c), 1);
  const __m256d xy13 = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(b)), _mm_load_pd(d), 1);
  const __m256d z02 = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(a + 2)), _mm_load_pd(c + 2), 1);
  const __m256d z13 = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(b + 2)), _mm_load_pd(d + 2), 1);
  x = _mm256_unpacklo_pd(xy02, xy13);
  y = _mm256_unpackhi_pd(xy02, xy13);
  z = _mm256_unpacklo_pd(z02, z13);
}

TISSU_INLINE void add_packed(double* to, __m256d xyz) {
  _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), xyz));
}

/// One lane after the other, so that lanes may share a node.
TISSU_INLINE void scatter_packed(double* values, const std::uint16_t* place, __m256d x, __m256d y,
                                 __m256d z) {
  const __m256d xy02 = _mm256_unpacklo_pd(x, y);
  const __m256d xy13 = _mm256_unpackhi_pd(x, y);
  const __m256d z02 = _mm256_unpacklo_pd(z, _mm256_setzero_pd());
  const __m256d z13 = _mm256_unpackhi_pd(z, _mm256_setzero_pd());
  add_packed(values + place[0], _mm256_permute2f128_pd(xy02, z02, 0x20));
  add_packed(values + place[1], _mm256_permute2f128_pd(xy13, z13, 0x20));
  add_packed(values + place[2], _mm256_permute2f128_pd(xy02, z02, 0x31));
  add_packed(values + place[3], _mm256_permute2f128_pd(xy13, z13, 0x31));
}

#endif

/// x, y and z of one node for each lane.
TISSU_INLINE void gather_packed(const double* values, const std::uint16_t* place, Batch (&out)[3]) {
#if defined(__AVX512F__)
  __m256d lo[3];
  __m256d hi[3];
  gather_packed(values, place, lo[0], lo[1], lo[2]);
  gather_packed(values, place + 4, hi[0], hi[1], hi[2]);
  for (int i = 0; i < 3; ++i) out[i].v = _mm512_insertf64x4(_mm512_castpd256_pd512(lo[i]), hi[i], 1);
#elif defined(__AVX2__)
  gather_packed(values, place, out[0].v, out[1].v, out[2].v);
#else
  static_assert(kWidth == 2);
  for (int i = 0; i < 3; ++i) out[i].v = Batch::Native{values[place[0] + i], values[place[1] + i]};
#endif
}

/// Adds a 3-vector to one node for each lane.
TISSU_INLINE void scatter_packed(double* values, const std::uint16_t* place, const Batch (&in)[3]) {
#if defined(__AVX512F__)
  scatter_packed(values, place, _mm512_castpd512_pd256(in[0].v), _mm512_castpd512_pd256(in[1].v),
                 _mm512_castpd512_pd256(in[2].v));
  scatter_packed(values, place + 4, _mm512_extractf64x4_pd(in[0].v, 1), _mm512_extractf64x4_pd(in[1].v, 1),
                 _mm512_extractf64x4_pd(in[2].v, 1));
#elif defined(__AVX2__)
  scatter_packed(values, place, in[0].v, in[1].v, in[2].v);
#else
  for (int lane = 0; lane < kWidth; ++lane) {
    for (int i = 0; i < 3; ++i) values[place[lane] + i] += in[i].v[lane];
  }
#endif
}

/// A 3-vector for each node of a chunk. Not initialised: it is made on the stack of every call.
struct PackedNodes {
  alignas(64) double values[4 * Chunk::kMostNodes];
  // Half a page on, so that the same node of two copies does not have the same low bits of its address: a
  // load would wait for the store to the other copy.
  double apart[264];

  void load(const Chunk& chunk, const double* from) {
    for (std::int32_t i = 0; i < chunk.node_count; ++i) {
      const double* node = at(from, chunk.nodes[i], 3);
      double* to = values + 4 * static_cast<std::ptrdiff_t>(i);
#if defined(__SSE2__)
      _mm_store_pd(to, _mm_loadu_pd(node));
      _mm_store_pd(to + 2, _mm_load_sd(node + 2));
#else
      for (int k = 0; k < 3; ++k) to[k] = node[k];
      to[3] = 0.0;
#endif
    }
  }
  void clear(const Chunk& chunk) {
    __builtin_memset(values, 0, 4 * sizeof(double) * static_cast<std::size_t>(chunk.node_count));
  }
  void add_to(const Chunk& chunk, double* to) const {
    for (std::int32_t i = 0; i < chunk.node_count; ++i) {
      double* node = at(to, chunk.nodes[i], 3);
      const double* from = values + 4 * static_cast<std::ptrdiff_t>(i);
#if defined(__SSE2__)
      _mm_storeu_pd(node, _mm_add_pd(_mm_loadu_pd(node), _mm_load_pd(from)));
      node[2] += from[2];
#else
      for (int k = 0; k < 3; ++k) node[k] += from[k];
#endif
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
