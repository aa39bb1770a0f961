// SPDX-License-Identifier: BSD-3-Clause
// The words of a scene file for what scene.hpp enumerates; of use inside this room only.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "cases/scene.hpp"

namespace bedscope::cases {

template <class T, std::size_t N>
using Words = std::array<std::pair<std::string_view, T>, N>;

inline constexpr Words<Arrangement, 4> arrangement_words{{{"bed", Arrangement::bed},
                                                          {"uniform", Arrangement::uniform},
                                                          {"lattice", Arrangement::lattice},
                                                          {"single", Arrangement::single}}};
inline constexpr Words<ContactModel, 2> contact_words{
    {{"linear", ContactModel::linear}, {"hertz", ContactModel::hertz}}};
inline constexpr Words<Supply, 3> supply_words{
    {{"closed", Supply::closed}, {"inventory", Supply::inventory}, {"feed", Supply::feed}}};
inline constexpr Words<Place, 3> inlet_words{
    {{"bottom", Place::bottom}, {"left", Place::left}, {"right", Place::right}}};
inline constexpr Words<Place, 3> outlet_words{
    {{"top", Place::top}, {"left", Place::left}, {"right", Place::right}}};
inline constexpr Words<Head, 3> head_words{
    {{"box", Head::box}, {"bend", Head::bend}, {"rough bend", Head::rough_bend}}};
inline constexpr Words<bool, 2> slip_words{{{"no-slip", false}, {"free-slip", true}}};
inline constexpr Words<VoidFraction, 2> void_fraction_words{
    {{"divided", VoidFraction::divided}, {"centre", VoidFraction::centre}}};
inline constexpr Words<bool, 2> coupling_words{{{"implicit", true}, {"explicit", false}}};

template <class T, std::size_t N>
std::string_view word_of(T value, const Words<T, N>& words) {
  for (const auto& [word, meaning] : words)
    if (meaning == value) return word;
  return {};
}

}  // namespace bedscope::cases
