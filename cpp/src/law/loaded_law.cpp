#include "tissu/law/loaded_law.h"

#include <dlfcn.h>

#include <array>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {
namespace {

template <class T>
std::span<const T> list(const T* first, std::int32_t count) {
  return {first, static_cast<std::size_t>(count)};
}

}  // namespace

void LoadedLaw::Close::operator()(void* handle) const { dlclose(handle); }

LoadedLaw::LoadedLaw(std::string path) : path_(std::move(path)) {
  open();
  check();
  read_tables();
}

LoadedLaw::~LoadedLaw() = default;

void LoadedLaw::open() {
  handle_.reset(dlopen(path_.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (handle_ == nullptr) {
    throw Error("the law in " + path_ + " cannot be loaded (" + dlerror() + "); make it again.");
  }
  using Entry = const LawLibrary* (*)();
  // The only way from what dlsym finds to a function.
  const auto entry = reinterpret_cast<Entry>(dlsym(handle_.get(), kLawLibraryEntry));
  if (entry != nullptr) library_ = entry();
  if (library_ == nullptr) {
    throw Error(path_ + " is not a law for this version of tissu: it has no " +
                std::string(kLawLibraryEntry) + "; make it again.");
  }
}

void LoadedLaw::check() const {
  const auto differs = [&](const char* what, auto found, auto accepted) {
    if (found == accepted) return;
    throw Error("the law in " + path_ + " has the " + what + " " + std::to_string(found) + ", and " +
                std::to_string(accepted) + " is accepted; make it again.");
  };
  differs("layout", library_->version, kLawLibraryVersion);
  differs("size", library_->bytes, static_cast<std::int32_t>(sizeof(LawLibrary)));
  differs("number of lanes", library_->lanes, static_cast<std::int32_t>(LawKernels::kLanes));
}

void LoadedLaw::read_tables() {
  const std::string_view set = library_->instruction_set;
  bool runs = false;
  for (const Isa isa : std::array{Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (tissu::name(isa) != set || !runs_here(isa)) continue;
    isa_ = isa;
    runs = true;
  }
  if (!runs) {
    throw Error("the law in " + path_ + " is compiled for " + std::string(set) +
                ", which does not run here; make it again.");
  }
  for (const LawLibraryParameter& p : list(library_->parameters, library_->parameter_count)) {
    parameters_.push_back(
        {p.name, p.unit, p.meaning, p.accepted, p.typical, p.lower, p.upper, p.lower_included != 0});
  }
  for (const char* constant : list(library_->constants, library_->constant_count)) {
    constants_.emplace_back(constant);
  }
  for (const LawLibraryKernels& k : list(library_->kernels, library_->kernel_count)) {
    kernels_.push_back({library_->name, library_->linear != 0, k.dimension, library_->constant_count,
                        k.energy, k.stress, k.stress_change, k.tangent, library_->isotropic != 0});
  }
  info_ = {library_->name,          parameters_,       constants_, library_->frame_invariant != 0,
           library_->addition != 0, library_->compute, nullptr};
}

const LawKernels* LoadedLaw::kernels(int dimension) const {
  for (const LawKernels& k : kernels_) {
    if (k.dimension == dimension) return &k;
  }
  return nullptr;
}

void LoadedLaw::compute(std::span<const double> parameters, std::span<double> constants) const {
  if (parameters.size() == parameters_.size()) {
    for (const LawLibraryRequirement& r : list(library_->requirements, library_->requirement_count)) {
      require(r.value(parameters.data()), info_.name, r.field, r.accepted);
    }
  }
  law_constants(info_, parameters, constants);
}

std::optional<Lame> LoadedLaw::small_strain(std::span<const double> parameters) const {
  if (library_->small_strain == nullptr) return std::nullopt;
  std::vector<double> constants(constants_.size());
  compute(parameters, constants);
  std::array<double, 2> values{};
  library_->small_strain(constants.data(), values.data());
  return Lame{values[0], values[1]};
}

}  // namespace tissu
