#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace solidnoise::papers {

// Computes something and writes it into a folder.
using Item = std::function<void(const std::filesystem::path& folder)>;

// The items of docs/papers/improving-gabor-noise.md (Lagae, Lefebvre, Dutre 2011).
std::map<std::string, Item> improving_gabor_noise_items();

}  // namespace solidnoise::papers
