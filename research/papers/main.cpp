#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "papers/items.h"

// papers ITEM FOLDER: computes one item of the pages of docs/papers and writes its data into a folder, for
// research/pages to draw. papers --list: the items, one a line.
int main(int argc, char** argv) {
  solidnoise::papers::Items items = solidnoise::papers::improving_gabor_noise_items();
  items.merge(solidnoise::papers::noise_by_example_items());
  items.merge(solidnoise::papers::gradient_noise_items());
  items.merge(solidnoise::papers::implementation_report_items());
  items.merge(solidnoise::papers::strata_items());
  const std::string first = argc > 1 ? argv[1] : "";
  if (argc == 2 && first == "--list") {
    for (const auto& [name, item] : items) std::cout << name << '\n';
    return 0;
  }
  if (argc == 2 && first == "--version") {
    std::cout << "Solidnoise " SOLIDNOISE_VERSION "\n";
    return 0;
  }
  if (argc != 3 || items.count(first) == 0) {
    std::cerr << "Usage: papers ITEM FOLDER, papers --list or papers --version\n";
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[2]);
    items.at(first)(argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "papers: " << error.what() << '\n';
    return 1;
  }
}
