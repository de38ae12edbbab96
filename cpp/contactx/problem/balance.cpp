// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "balance.h"
#include "../text.h"

using namespace contactx;
using namespace contactx::problem;

std::vector<std::string> Balance::lines() const
{
  const auto text = [](double value) { return number_text(value, 6); };
  std::string components;
  for (const double p : momentum)
    components += (components.empty() ? "" : ", ") + text(p);
  return {"time step " + text(dt) + ": kinetic energy " + text(kinetic)
              + (strain ? ", strain energy " + text(*strain) : "")
              + ", momentum (" + components + ")",
          "work of loads " + text(work_of_loads) + ", of supports "
              + text(work_of_supports) + ", lost in contact "
              + text(contact_loss)};
}
