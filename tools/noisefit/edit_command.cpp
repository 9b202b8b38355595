#include <algorithm>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_options.h"
#include "common/run_tool.h"
#include "noisefit/commands.h"
#include "noisefit/fit_flags.h"
#include "noisefit/model_file.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/edit_model.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/image/color.h"
#include "solidnoise/image/drawing.h"
#include "solidnoise/image/image_file.h"

namespace solidnoise {
namespace {

constexpr char kEditDescription[] =
    "noisefit edit changes a spectrum file: the components of one group, or all of them. What is asked for "
    "is\n"
    "done in the order in which it is listed here.";

// What a flag does to a channel.
struct Operation {
  std::string flag;
  std::function<void(GaborSpectrum&, std::size_t channel)> run;
};

struct EditCommand : RunOptions {
  int selected = 0;  // components of all channels, by --select
  std::string in;
  std::string out;
  std::string preview;
  GroupChoice group;
  std::optional<int> channel;
  std::vector<Operation> operations;

  void add(const std::string& flag,
           const std::function<void(GaborSpectrum&, const GroupChoice&)>& operation) {
    operations.push_back(
        {flag, [this, operation](GaborSpectrum& spectrum, std::size_t) { operation(spectrum, group); }});
  }
};

// The component that "A VARIANCE X Y [Z]" describes.
void add_one(GaborSpectrum& spectrum, const std::vector<double>& v, const std::string& group) {
  SpectrumComponent component;
  component.variance = v[1];
  for (std::size_t i = 2; i < v.size(); ++i) component.frequency[static_cast<int>(i) - 2] = v[i];
  add_component(spectrum, v[0], component, group);
}

// A flag with a factor or an angle, of which `edit` makes the group another one.
void declare_number(FlagSet& flags, EditCommand& command, const std::string& flag, const std::string& unit,
                    const std::string& help, void (*edit)(GaborSpectrum&, const GroupChoice&, double)) {
  flags.number(flag, unit, help, [flag, edit, &command](double value) {
    command.add(flag, [edit, value](GaborSpectrum& s, const GroupChoice& group) { edit(s, group, value); });
  });
}

// The noise of a model at its exemplar's size, and that of what was made of it, of the same seed.
constexpr int kSide = 320;
Image draw_both(const ExemplarModel& before, const ExemplarFile& after) {
  constexpr int kMargin = 12;
  constexpr std::uint64_t kSeed = 1;
  Image sheet(2 * kSide + 3 * kMargin, kSide + 2 * kMargin, 3);
  fill_rectangle(sheet, {0.0, 0.0, double(sheet.width), double(sheet.height)}, Color(1.0f));
  int left = kMargin;
  for (const ExemplarModel* const model : {&before, &after.model}) {
    const Vec<2> step(after.pixel_size.value_or(1.0));
    Image picture =
        image_of_exemplar(procedural_texture(*model, glm::ivec2(kSide), step, Vec<3>(0.0), kSeed));
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        for (int c = 0; c < 3; ++c) {
          const float value = std::clamp(picture.at(x, y, c), 0.0f, 1.0f);
          picture.at(x, y, c) = model->raw_values ? value : srgb_from_linear(value);
        }
      }
    }
    paste(sheet, picture, left, kMargin);
    left += kSide + kMargin;
  }
  return sheet;
}

// Editing takes next to nothing beside the files; a pixel of the previews what its noise and its picture do.
void require_cost(const EditCommand& command, const ExemplarModel& before, const ExemplarModel& after) {
  if (command.preview.empty()) return command.require_cost("the edit", {0.1, kProgramBytes + 12.0 * 0x1p20});
  double pixels = 0.0;
  for (const ExemplarModel* const model : {&before, &after}) {
    pixels += static_cast<double>(model->channels.size()) * kSide * kSide;
  }
  command.require_cost("the preview", {3e-6 * pixels, kPictureProgramBytes + 100.0 * pixels});
}

void declare_flags(FlagSet& flags, EditCommand& command) {
  flags.argument("FILE", "The spectrum file, - for the standard input", command.in);
  flags.group("Flags");
  flags.keep("--out", "FILE.json", "Where the result goes; - for the standard output", command.out);
  flags.keep("--preview", "FILE.png", "A picture of the noise before, on the left, and after",
             command.preview);
  flags.text("--group", "NAME", "The group to work on (default: all components)",
             [&](const std::string& name) { command.group = name; });
  flags.integer("--channel", "NUMBER", "The channel to work on, from 0 (default: all)",
                [&](int number) { command.channel = number; });
  declare_fields<RunOptions>(flags, command, {"force", "max_memory", "max_time", "quiet"});
  flags.group("What to do");
  flags.toggle("--regroup", "Sort the components into groups anew, after Wold", [&] {
    command.operations.push_back(
        {"--regroup", [](GaborSpectrum& spectrum, std::size_t) { spectrum = group_spectrum(spectrum); }});
  });
  flags.numbers(
      "--select", "FROM TO [DEGREES SPREAD]",
      "Make the components of these frequencies, cycles per unit, and of directions within SPREAD of "
      "DEGREES, "
      "the group \"selected\", to work on or rename by --group selected",
      [&](const std::vector<double>& v) {
        if (v.size() != 2 && v.size() != 4) {
          throw UsageError("--select takes two numbers or four: FROM TO [DEGREES SPREAD]");
        }
        ComponentSelection selection{v[0], v[1]};
        if (v.size() == 4) {
          selection.direction = v[2];
          selection.spread = v[3];
        }
        command.operations.push_back(
            {"--select", [selection, &command](GaborSpectrum& spectrum, std::size_t) {
               command.selected += select_group(spectrum, {}, selection, "selected");
             }});
      });
  declare_number(
      flags, command, "--rotate", "DEGREES", "Turn counterclockwise (in 3D about the z axis)",
      [](GaborSpectrum& s, const GroupChoice& group, double degrees) { rotate_group(s, group, degrees); });
  declare_number(flags, command, "--scale", "FACTOR", "Multiply the frequencies", scale_group);
  flags.numbers(
      "--translate", "X Y [Z]", "Add to the frequencies, cycles per unit", [&](const std::vector<double>& v) {
        const Vec<3> by(v[0], v[1], v.size() > 2 ? v[2] : 0.0);
        command.add("--translate",
                    [by](GaborSpectrum& s, const GroupChoice& group) { translate_group(s, group, by); });
      });
  declare_number(flags, command, "--magnitude", "FACTOR", "Multiply the amplitudes", scale_magnitude);
  declare_number(flags, command, "--bandwidth", "FACTOR", "Multiply the bandwidths", scale_bandwidth);
  flags.numbers("--add", "A VARIANCE X Y [Z]", "Add a component, to --group or \"added\"",
                [&](const std::vector<double>& v) {
                  command.add("--add", [v](GaborSpectrum& s, const GroupChoice& group) {
                    add_one(s, v, group.value_or("added"));
                  });
                });
  flags.text("--rename", "NAME", "Give --group another name, or join it with that group",
             [&](const std::string& name) {
               command.add("--rename", [name](GaborSpectrum& s, const GroupChoice& group) {
                 if (!group) throw UsageError("--rename needs --group, the group to rename");
                 rename_group(s, *group, name);
               });
             });
  flags.toggle("--remove", "Remove --group", [&] {
    command.add("--remove", [](GaborSpectrum& s, const GroupChoice& group) {
      if (!group) throw UsageError("--remove needs --group, the group to remove");
      remove_group(s, *group);
    });
  });
  flags.text("--copy", "FILE.json", "Add --group, or all, of another file, channel by channel",
             [&](const std::string& file) {
               const ExemplarModel from = read_model(file).model;
               const auto copy = [&command, from](GaborSpectrum& s, std::size_t channel) {
                 if (channel >= from.channels.size()) return;
                 const GaborSpectrum& source = from.channels[channel];
                 if (command.group && !has_group(source, *command.group)) return;
                 copy_group(s, source, command.group);
               };
               command.operations.push_back({"--copy", copy});
             });
}

}  // namespace

int run_edit(const std::vector<std::string>& arguments) {
  EditCommand command;
  FlagSet flags("noisefit edit", kEditDescription);
  declare_flags(flags, command);
  flags.parse(arguments);
  flags.apply();
  if (command.out.empty() && command.preview.empty()) {
    throw UsageError("--out is missing; say where the result goes: --out new.json");
  }
  if (command.operations.empty()) throw UsageError("there is nothing to do; say --rotate, --scale, ...");
  require_extension("--out", command.out, {".json"}, StandardOutput::allowed);
  require_extension("--preview", command.preview, {".png", ".jpg", ".tif", ".exr"}, StandardOutput::refused);
  require_outputs({{command.out, {command.in}}, command.preview}, command.existing(),
                  {command.in, flags.value_of("--copy").value_or("")});

  ExemplarFile edited_file = read_model(command.in);
  const ExemplarModel before = edited_file.model;
  ExemplarModel& model = edited_file.model;
  if (command.channel &&
      (*command.channel < 0 || *command.channel >= static_cast<int>(model.channels.size()))) {
    throw UsageError(fmt::format("--channel is {}; {} has {}, from 0", *command.channel, command.in,
                                 model.channels.size()));
  }
  const bool makes_group =
      flags.given("--add") || flags.given("--copy") || flags.given("--regroup") || flags.given("--select");
  const EditTarget target{command.group, command.channel, makes_group};
  const bool edited = edit_model(model, target, [&](GaborSpectrum& spectrum, std::size_t channel) {
    for (const Operation& operation : command.operations) {
      try {
        operation.run(spectrum, channel);
      } catch (const std::invalid_argument& error) {
        throw UsageError(
            fmt::format("{}: {}: channel {}: {}", operation.flag, command.in, channel, error.what()));
      }
    }
  });
  if (flags.given("--select") && command.selected == 0)
    throw UsageError(fmt::format("--select: {}: there are no such components", command.in));
  if (!edited) throw UsageError(fmt::format("{} has no group {}", command.in, *command.group));
  require_cost(command, before, model);
  OutputGroup outputs;
  if (!command.preview.empty()) {
    write_image(command.preview, draw_both(before, edited_file),
                {.existing = command.existing(), .group = &outputs});
  }
  if (!command.out.empty()) {
    write_model(command.out, edited_file, {.existing = command.existing(), .group = &outputs});
  }
  outputs.appear();
  if (!command.quiet) std::cerr << describe(model);
  return kDone;
}

}  // namespace solidnoise
