// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "registry.h"
#include "frictional.h"
#include "frictionless.h"
#include "mortar.h"
#include "mortar_tied.h"
#include "rigid.h"
#include "rigid_mortar.h"
#include "tied.h"
#include <stdexcept>
#include <string>

using namespace contactx::kernel;

std::span<const Entry> contactx::kernel::registry()
{
  static const std::vector<Entry> entries = []
  {
    std::vector<Entry> all;
    for (auto& part : {frictionless(), frictional(), tied(), rigid(), mortar(),
                       mortar_tied(), rigid_mortar()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return entries;
}

const Entry& contactx::kernel::find(Law law, std::string_view sliding,
                                    std::string_view term, int num_nodes,
                                    int gdim, int num_slaves)
{
  for (const Entry& e : registry())
    if (e.law == law and e.sliding == sliding and e.term == term
        and e.num_nodes == num_nodes and e.gdim == gdim
        and e.num_slaves == num_slaves)
      return e;
  throw std::invalid_argument("there is no kernel for " + std::string(sliding)
                              + " sliding, term " + std::string(term)
                              + " and facets of " + std::to_string(num_nodes)
                              + " nodes");
}
