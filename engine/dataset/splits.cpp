// SPDX-License-Identifier: MIT
#include "dataset/splits.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "dataset/sample.h"

namespace sigs {

namespace {

struct Unit {
  std::string name;
  std::vector<std::size_t> members;
  std::string split;  // fixed, or not yet known
  std::uint64_t rank = 0;
};

// Two kinds of names, which must differ.
std::string unit_name(const SplitCandidate& candidate) {
  return candidate.unit.empty() ? "video " + candidate.video : "unit " + candidate.unit;
}

Result<std::vector<Unit>> units_of(std::span<const SplitCandidate> candidates, std::uint64_t seed) {
  std::map<std::string, Unit> units;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const SplitCandidate& candidate = candidates[i];
    const std::string name = unit_name(candidate);
    Unit& unit = units[name];
    unit.name = name;
    unit.members.push_back(i);
    unit.rank = random_bits({seed, name, "split"});
    if (candidate.fixed.empty() || candidate.fixed == unit.split) continue;
    if (!unit.split.empty())
      return fail("", fmt::format("\"{}\" is in {} and in {}, but keep_together keeps it in one split", candidate.unit,
                                  unit.split, candidate.fixed));
    unit.split = candidate.fixed;
  }
  std::vector<Unit> list;
  for (auto& [name, unit] : units) list.push_back(std::move(unit));
  return list;
}

bool goes_first(const Unit& a, const Unit& b) {
  if (a.members.size() != b.members.size()) return a.members.size() > b.members.size();
  return a.rank != b.rank ? a.rank < b.rank : a.name < b.name;
}

void share_out(std::vector<Unit*>& units, std::span<const SplitShare> shares) {
  std::sort(units.begin(), units.end(), [](const Unit* a, const Unit* b) { return goes_first(*a, *b); });
  double videos = 0;
  for (const Unit* const unit : units) videos += static_cast<double>(unit->members.size());
  std::vector<double> lacking;
  for (const SplitShare& share : shares) lacking.push_back(share.share * videos);
  for (Unit* const unit : units) {
    const auto neediest = std::max_element(lacking.begin(), lacking.end());
    *neediest -= static_cast<double>(unit->members.size());
    unit->split = shares[static_cast<std::size_t>(neediest - lacking.begin())].name;
  }
}

}  // namespace

Result<std::vector<std::string>> splits_of(std::span<const SplitCandidate> candidates,
                                           std::span<const SplitShare> shares, std::uint64_t seed) {
  Result<std::vector<Unit>> units = units_of(candidates, seed);
  if (!units) return fail(units.error());
  std::vector<Unit*> open;
  for (Unit& unit : *units)
    if (unit.split.empty()) open.push_back(&unit);
  if (!shares.empty()) share_out(open, shares);
  std::vector<std::string> splits(candidates.size());
  for (const Unit& unit : *units)
    for (const std::size_t member : unit.members) splits[member] = unit.split;
  return splits;
}

}  // namespace sigs
