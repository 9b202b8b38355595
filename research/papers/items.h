#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace solidnoise::papers {

// Computes something and writes it into a folder.
using Item = std::function<void(const std::filesystem::path& folder)>;
using Items = std::map<std::string, Item>;

// The items of docs/papers/improving-gabor-noise.md (Lagae, Lefebvre, Dutre 2011), noise-by-example.md
// (Galerne, Lagae, Lefebvre, Drettakis 2012), gradient-noise.md (Kensler, Knoll, Shirley 2008) and
// implementation-report.md (Ling).
Items improving_gabor_noise_items();
Items noise_by_example_items();
Items gradient_noise_items();
Items implementation_report_items();

// Those of impulses-in-strata.md, which is of no paper.
Items strata_items();

}  // namespace solidnoise::papers
