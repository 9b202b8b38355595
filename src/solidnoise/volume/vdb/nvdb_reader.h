#pragma once

#include <filesystem>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/vdb/grid_source.h"

namespace solidnoise {

// Reads .nvdb files, of NanoVDB's version 32, uncompressed: grids of floats, of 4, 8 or 16 bits each or
// whole, and of vectors, as OpenVDB grids. How values were stored is their metadata "stored_as".
class NvdbReader final : public GridSource {
 public:
  // Where `progress`, which may be null, asks to stop, throws Cancelled.
  explicit NvdbReader(const std::filesystem::path& path, Progress* progress = nullptr);

  const openvdb::MetaMap& metadata() const override { return metadata_; }
  std::size_t grid_count() const override { return grids_.size(); }
  std::string grid_name(std::size_t index) const override { return grids_[index]->getName(); }
  openvdb::GridBase::Ptr read_header(std::size_t index) override { return grids_[index]; }
  openvdb::GridBase::Ptr read_grid(std::size_t index) override { return grids_[index]; }
  openvdb::GridPtrVec read_grids() override { return grids_; }

 private:
  openvdb::MetaMap metadata_;
  openvdb::GridPtrVec grids_;
};

}  // namespace solidnoise
