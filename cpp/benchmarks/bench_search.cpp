// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Times of the box tree, of the pairing and of surface-to-surface pairs, on one
// core, and how they grow.

#include "table.h"
#include "wavy.h"
#include <cmath>
#include <contactx/search/facet_search.h>
#include <contactx/search/pairing.h>
#include <cstdlib>
#include <map>
#include <stdexcept>

using namespace contactx;
using namespace contactx::benchmarks;
using namespace contactx::search;

namespace
{
using Times = std::vector<std::pair<std::string, double>>;

/// Times of the tree of the master's boxes; a query is one slave node.
void time_tree(const WavySquares& w, int repeats, Times& times)
{
  const Surface master(w.master_offsets, w.master_nodes, 3);
  std::vector<Box> boxes;
  times.emplace_back("boxes",
                     best_seconds(repeats, [&] { boxes = master.boxes(w.x); }));
  std::optional<BoxTree> tree;
  times.emplace_back("tree build",
                     best_seconds(repeats, [&] { tree.emplace(boxes); }));
  times.emplace_back("tree refit",
                     best_seconds(repeats, [&] { tree->refit(boxes); }));
  std::size_t found = 0;
  const double t = best_seconds(
      1,
      [&]
      {
        for (std::size_t i = 0; i < w.slave_node.size(); ++i)
          if (w.slave_node[i])
            found += nearest_facet(master, *tree, w.x,
                                   {w.x[3 * i], w.x[3 * i + 1], w.x[3 * i + 2]},
                                   {0, 0, -1}, 1)
                         .has_value();
      });
  if (found
      != static_cast<std::size_t>(
          std::count(w.slave_node.begin(), w.slave_node.end(), 1)))
    throw std::runtime_error("a query found no facet");
  times.emplace_back("queries", t);
}

/// Times of a pairing: from nothing, and the updates of a Newton loop.
void time_pairing(WavySquares& w, Times& times)
{
  std::optional<Pairing> pairing;
  const double build = seconds(
      [&]
      {
        pairing.emplace(w.slave_offsets, w.slave_nodes, w.master_offsets,
                        w.master_nodes, 3);
      });
  const std::vector<std::int8_t> closed(pairing->slaves().size(), 0);
  const auto update = [&] { pairing->update(w.x, 1, closed); };
  const double first = seconds(update);
  for (std::int32_t f : pairing->facet())
    if (f < 0)
      throw std::runtime_error("a slave node has no pair");
  times.emplace_back("pairing built", build);
  times.emplace_back("first update", first);
  times.emplace_back("built + first", build + first);
  times.emplace_back("nothing moved", best_seconds(3, update));
  w.move(1e-3 * w.size, 1e-3 * w.size);
  times.emplace_back("moved a little", seconds(update));
  w.move(0.5 * w.size, 0);
  times.emplace_back("slid half a facet", seconds(update));
  w.move(0, 20 * w.size);
  times.emplace_back("moved far off", seconds(update));
  times.emplace_back("still far off", seconds(update));
}

/// Times of surface-to-surface pairs: found from nothing and again, with the
/// margin of finite sliding, and integrated.
/// @return Number of pairs.
std::size_t time_facets(const WavySquares& w, int repeats, Times& times)
{
  search::FacetSearch search(w.slave_offsets, w.slave_nodes, w.master_offsets,
                             w.master_nodes, 3);
  geometry::FacetPairs pairs;
  const auto find = [&] { pairs = search.find(w.x, 1, 0.1); };
  times.emplace_back("facets: first", seconds(find));
  times.emplace_back("facets: again", best_seconds(repeats, find));
  geometry::Integrals found;
  times.emplace_back("facets: integrals",
                     best_seconds(repeats,
                                  [&]
                                  {
                                    found = geometry::integrals(
                                        search.slave(), search.master(), pairs,
                                        w.x, w.x, 3);
                                  }));
  if (std::ranges::count(found.area, 0.0) != search.slave().size())
    throw std::runtime_error("a slave facet faces no master");
  return pairs.size();
}

/// @param[out] num_pairs Number of pairs of facets.
Times run(int n, bool shuffled, std::size_t& num_pairs)
{
  Times times;
  WavySquares w(n, 0.3, shuffled);
  const int repeats = n > 300000 ? 3 : 10;
  time_tree(w, repeats, times);
  num_pairs = time_facets(w, repeats, times);
  time_pairing(w, times);
  return times;
}
} // namespace

int main(int argc, char** argv)
{
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1000000;
  const std::string folder = argc > 2 ? std::string(argv[2]) + "/" : "";
  for (const bool shuffled : {false, true})
  {
    std::cout << "\nSlave nodes against as many master facets, numbered "
              << (shuffled ? "at random" : "row by row")
              << "; times in s, growth as n^k over the last decade\n";
    std::vector<int> sizes;
    std::vector<Times> all;
    std::size_t num_pairs = 0;
    for (int n = 1000; n <= largest; n *= 10)
    {
      sizes.push_back(n);
      all.push_back(run(n, shuffled, num_pairs));
    }
    std::vector<std::string> head{"what"};
    for (int n : sizes)
      head.push_back("n=" + std::to_string(n));
    head.push_back("k");
    head[0].resize(18, ' ');
    Table table(folder + (shuffled ? "search_shuffled.csv" : "search.csv"),
                head);
    for (std::size_t i = 0; i < all[0].size(); ++i)
    {
      std::vector<std::string> cells{all[0][i].first};
      for (const Times& t : all)
        cells.push_back(number(t[i].second));
      const std::size_t last = all.size() - 1;
      cells.push_back(last == 0 ? "-"
                                : number(std::log10(all[last][i].second
                                                    / all[last - 1][i].second),
                                         2));
      table.row(cells);
    }
    std::map<std::string, double> t(all.back().begin(), all.back().end());
    std::cout << "a build costs " << number(t["tree build"] / t["tree refit"])
              << " refits; a query takes "
              << number(1e6 * t["queries"] / sizes.back()) << " us\n"
              << num_pairs << " pairs of facets: "
              << number(1e-6 * num_pairs / t["facets: again"])
              << " million a second are found, "
              << number(1e-6 * num_pairs / t["facets: integrals"])
              << " integrated\n";
  }
}
