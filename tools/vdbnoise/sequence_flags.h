#pragma once

#include "common/flag_set.h"
#include "vdbnoise/make_options.h"

namespace solidnoise {

// Declares --frames and --fps, and --shard and --region.
void declare_sequence_flags(FlagSet& flags, MakeOptions& options);

// Refuses frames that would all be the same, that have no place in the outputs' names, or that do not fit the
// recipe's loop; and parts of what cannot be cut. Throws UsageError.
void check_sequence(const FlagSet& flags, const MakeOptions& options);

// Whether the frames are densities that are all to be scaled by one factor, which is still to be measured.
bool shares_density_factor(const MakeOptions& options);
// Whether they are scaled one by one instead, since each has an input of its own: there is no first among
// them that would be the same whichever frames are asked for.
bool scales_each_frame(const MakeOptions& options);

// What is to be made for one of the frames: names with its number, and its moment. The moment of frame n is
// the recipe's own plus n / fps; frames that are a loop apart have the same.
MakeOptions options_of_frame(const MakeOptions& options, std::size_t index);

}  // namespace solidnoise
