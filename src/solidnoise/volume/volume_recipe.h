#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/modify/modification.h"
#include "solidnoise/volume/output.h"
#include "solidnoise/volume/parameters/parameter_grids.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/vdb/vdb_write.h"

namespace solidnoise {

// Which voxels a volume has: those of the recipe's box, of the sphere or ellipsoid inscribed in it, of the
// inside of a mesh, or those that are active in a grid that exists.
struct BoxShape {
  friend bool operator==(const BoxShape&, const BoxShape&) = default;
};
struct SphereShape {
  friend bool operator==(const SphereShape&, const SphereShape&) = default;
};
struct EllipsoidShape {
  friend bool operator==(const EllipsoidShape&, const EllipsoidShape&) = default;
};
struct MeshShape {
  std::string file{};    // .ply .obj .off .stl .om, a closed mesh; its own bounds take the place of the box
  std::string digest{};  // file_digest() of it, where the volume exists already; empty: any file will do
  friend bool operator==(const MeshShape&, const MeshShape&) = default;
};
using GridShape = GridFile;  // the grid's own frame takes the place of box and voxel size
using Shape = std::variant<BoxShape, SphereShape, EllipsoidShape, MeshShape, GridShape>;

// What the densities are scaled to. Noise that is not shaped (RawShaping) is never scaled.
struct DensityScale {
  // Optical depth through the thickest column along the up axis: the integral of the density, which is
  // extinction per world unit. > 0
  double optical_depth = 60.0;
  // The largest density instead, where it is given; > 0
  std::optional<double> peak{};
  // What the densities are multiplied by, where that is known already: one factor for all frames of a
  // sequence, as measure_density_factor() gives it. The two above then say what it was measured for. > 0
  std::optional<double> factor{};

  friend bool operator==(const DensityScale&, const DensityScale&) = default;
};

// A field, and the grids that are made of it.
struct GridRecipe {
  std::string grid{};  // the grid's name, where there is one; empty: as default_grid_name() says

  std::optional<NoiseRecipe> own{};  // a noise of its own; none: that of the recipe. Its seed is mixed with
                                     // the recipe's
  std::vector<Layer> layers{};       // their sum takes the noise's place; see Layer. Not of a cloud
  Shaping shaping{};  // RawShaping where the output is not the value; then also Range::raw, but for colours
  DensityScale density{};

  std::vector<Output> output{Output::value};  // what grids are made, in this order; see validate_outputs
  double speed = 1.0;  // of Output::curl: root mean square, world units per second; > 0
  Vec<3> drift{0.0};   // of Output::curl: a mean velocity that is added
  // Of Output::curl: a level set that the velocity does not cross, and the distance over which it turns along
  // it, world units; > 0; else the noise's wavelength, 1 / frequency.
  std::optional<GridFile> boundary{};
  std::optional<double> boundary_width;

  std::optional<Layer> within{};  // clamped to 0..1, what the values are multiplied by
  bool sparse = false;  // of raw values: voxels that are 0 are inactive, as they are of densities, and where
                        // there is a `within`
  double prune = 0.0;   // of densities: those below this part of the largest one are left out; 0 to 1
  bool half = false;    // store 16-bit floats

  friend bool operator==(const GridRecipe&, const GridRecipe&) = default;
};

// Where there are voxels.
struct Domain {
  Shape shape{};
  Box<3> box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};  // world units; `shape` says what of it is filled
  std::optional<double> voxel{};                    // size in world units; > 0; else from `dim`
  int dim = 256;                                    // voxels along the longest side; 1 to 2^20
  std::optional<double> edge;  // of densities: over which they end at the shape's surface, world units; at
                               // least 0
  std::optional<double> edge_voxels;  // the same in voxels, in place of `edge`; without both two, of a box 0

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
};

// What a preview shows a volume as.
enum class PreviewLook {
  automatic,  // a fire where there is a temperature, a cloud where there is a density, else a solid
  cloud,      // white, under a sun, before a blue sky
  smoke,      // grey, before an overcast one
  fire,       // glowing by its temperature and flame, before black
  nebula,     // glowing by its density, before black
  solid,      // a body whose surface has the values' colours
};

// Everything that defines a volume: plain data. The same recipe makes the same grids, bit for bit.
struct VolumeRecipe : GridRecipe, Domain {
  std::string description{};  // for people; changes nothing

  NoiseRecipe noise{};
  int dims = 3;                 // 3, or 4: a frame of a noise that changes in time
  double time = 0.0;            // of the frame: in the noise's fourth axis, or of its Evolution; else 0
  ParameterGrids parameters{};  // of the noise, where they vary in space; of Output::value. Kernels vary in
                                // layers of the recipe's noise
  Vec<3> offset{0.0};           // moves the noise, world units; +-1e9
  Vec<3> wind{0.0};             // moves it as time passes, world units per unit of time; +-1e9
  bool band_limit = false;      // filter the noise at the size of the voxels: at_resolution()
  bool exact = false;           // sum impulses at every voxel, where fewer samples would do within the error

  NamedLayers fields{};                          // for layers to use
  std::optional<NoiseRecipe> noise_of_fields{};  // of those that name none; none: `noise`, as it is but in
                                                 // short forms of grids with noises of their own

  // Several grids of the same voxels; then those of the recipe itself are left as they are by default. A
  // recipe without these is the short form of one with a single entry, itself. See recipes_of_grids().
  std::vector<GridRecipe> grids{};

  // Instead of a grid of its own: shape, box and voxels are those of the grid that is modified, whose name
  // and precision stay, and the density is scaled only where it replaces what was there.
  std::optional<Modification> modification{};

  UpAxis up = UpAxis::y;
  Codec codec = Codec::blosc;
  PreviewLook look = PreviewLook::automatic;  // of previews; changes nothing else

  // Throws std::invalid_argument naming the field, its value and what is allowed. `path` is where a short
  // form's own grid was read, such as "grids[0].".
  void validate(const std::string& path = {}) const;
};

// The recipe in short forms: one of each entry of its grids, with its noise; itself if there are none.
std::vector<VolumeRecipe> recipes_of_grids(const VolumeRecipe& recipe);

// Which of them has the grid of a name; the first if none has.
std::size_t entry_of_grid(const VolumeRecipe& recipe, const std::string& name);
VolumeRecipe recipe_of_grid(const VolumeRecipe& recipe, const std::string& name);

// Throws std::invalid_argument for a name that no grid of the recipe has.
void require_grid(const VolumeRecipe& recipe, const std::string& name);

// Entry i of the recipe's grids, or the recipe itself, to be changed.
GridRecipe& grid_of(VolumeRecipe& recipe, std::size_t i);

// All noises that a short form is made of, as they are made: its own, or those of its layers and of `within`.
std::vector<NoiseRecipe> noises_of(const VolumeRecipe& recipe);

// Whether a short form has an output that is made from the noise's gradient, and a noise as it is made for
// the outputs: its gradient within the error, too, where there is one.
bool has_gradient(const VolumeRecipe& recipe);
NoiseRecipe noise_of_output(const VolumeRecipe& recipe, const NoiseRecipe& noise);

// The names of all grids, in their order.
std::vector<std::string> grid_names(const VolumeRecipe& recipe);

// How far the noise has moved at the recipe's time, world units.
Vec<3> moved(const VolumeRecipe& recipe);

// The up axis: 1 or 2.
int vertical_axis(const VolumeRecipe& recipe);

// Whether the recipe makes one grid of values, and no other.
bool is_scalar(const VolumeRecipe& recipe);

// Whether a recipe's noise can be filtered: Gabor noises of 3 dimensions whose kernels are the same
// everywhere. (In 4 the filter would blur time; folds and warps of layers make frequencies of their own.)
bool may_band_limit(const VolumeRecipe& recipe);

// The recipe as it is on voxels of a size: where band_limit says so, its noise is convolved with a Gaussian
// whose standard deviation is kBandLimit of the voxel's longest side, exactly; nothing is renormalised.
// Finer voxels then change values by what the finer filter lets pass, and nothing else: neither the impulses
// nor their amplitude. Half a voxel leaves white noise 2.6 % of its power above the highest frequency that
// voxels can hold, 0.5 cycles per voxel (0.3 voxels: 18 %, 0.4: 7.6 %), and takes 7 % off the amplitude of
// waves of 8 voxels; the interpolation that renderers use is as wide (0.41 voxels, of a tent).
inline constexpr double kBandLimit = 0.5;
VolumeRecipe at_resolution(const VolumeRecipe& recipe, const Vec<3>& voxel_size);

// Whether a noise of the recipe evolves, its own or one of a layer.
bool evolves(const VolumeRecipe& recipe);

// The exemplar whose own colours Output::color has; null where the noise is not by an example in colour, or
// its values are to be of another range than their own.
const ExemplarModel* exemplar_of_colors(const VolumeRecipe& recipe);

}  // namespace solidnoise
