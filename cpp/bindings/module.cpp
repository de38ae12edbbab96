// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"

PYBIND11_MODULE(cpp, m)
{
  m.doc() = "C++ core of contactx, free of DOLFINx and PETSc";
  contactx_bindings::parallel(m);
  contactx_bindings::master(m);
  contactx_bindings::obstacle(m);
  contactx_bindings::facet(m);
  contactx_bindings::search(m);
  contactx_bindings::node_state(m);
  contactx_bindings::deformable(m);
  contactx_bindings::law(m);
  contactx_bindings::slave_nodes(m);
  contactx_bindings::contact(m);
  contactx_bindings::results(m);
  contactx_bindings::condense(m);
  contactx_bindings::algebra(m);
  contactx_bindings::conductance(m);
  contactx_bindings::bodies(m);
  contactx_bindings::mesh(m);
  contactx_bindings::reference(m);
  contactx_bindings::newton(m);
  contactx_bindings::kernel(m);
  contactx_bindings::audit(m);
  contactx_bindings::problem(m);
  contactx_bindings::dynamics(m);
  contactx_bindings::checkpoint(m);
}
