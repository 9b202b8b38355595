#pragma once

#include <type_traits>

#include "solidnoise/core/fields.h"
#include "solidnoise/volume/modify/modification.h"
#include "solidnoise/volume/parameters/parameter_grids.h"
#include "solidnoise/volume/vdb/grid_file.h"

namespace solidnoise {

// The tables of what a volume's recipe says of grids in files, and its words.

inline constexpr Choices<Combine, 4> kCombineChoices{{
    {Combine::replace, "replace"},
    {Combine::add, "add"},
    {Combine::multiply, "multiply"},
    {Combine::erode, "erode"},
}};

constexpr auto fields_of(std::type_identity<GridFile>) {
  return list_fields(field("file", &GridFile::file, "A .vdb"),
                     field("grid", &GridFile::grid, "Name in the file; empty: the first one that will do"),
                     field("digest", &GridFile::digest, "Of the file, where the volume exists already")
                         .written_if([](const GridFile& source) { return !source.digest.empty(); }));
}

constexpr auto fields_of(std::type_identity<ParameterGrid>) {
  return list_fields(part(&ParameterGrid::source),
                     field("map", &ParameterGrid::map, "Values LOW and HIGH of the grid mean the other two"));
}

constexpr auto fields_of(std::type_identity<ParameterGrids>) {
  using Grids = ParameterGrids;
  return list_fields(
      field("frequency_grid", &Grids::frequency, "Frequency at each voxel, cycles per world unit"),
      field("bandwidth_grid", &Grids::bandwidth, "Bandwidth at each voxel, 0.1 to 4 octaves"),
      field("magnitude_grid", &Grids::magnitude, "What the noise is multiplied by at each voxel, sigmas"),
      field("direction_grid", &Grids::direction, "Where the waves travel at each voxel: vectors"));
}

constexpr auto fields_of(std::type_identity<Modification>) {
  return list_fields(
      field("on", &Modification::on, "The grid to work on, in place of one of the recipe's own")
          .written_if([](const Modification& change) { return !change.on.file.empty(); }),
      field("displace", &Modification::displace, kFinite, "world units",
            "Of a level set, in place of combine and amount: how far one sigma moves its surface"),
      field("combine", &Modification::combine, kCombineChoices,
            "Noise n in place of value v; v + a n; v (1 + a n); or wear thin parts off")
          .written_if([](const Modification& change) { return !change.displace; }),
      field("amount", &Modification::amount, kFinite, "", "The factor a")
          .written_if([](const Modification& change) {
            return !change.displace && change.combine != Combine::replace;
          }),
      field("mask", &Modification::mask, "Limits the change to where this is over 0"),
      field("rest", &Modification::rest, "Rest positions, at which the noise is looked up"));
}

}  // namespace solidnoise
