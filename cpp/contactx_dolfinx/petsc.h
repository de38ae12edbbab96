// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <petscksp.h>
#include <span>
#include <type_traits>

namespace contactx_dolfinx::petsc
{
static_assert(std::is_same_v<PetscScalar, double>,
              "contactx needs a PETSc of real numbers in double precision");

/// @brief Throw what PETSc says of an error.
/// @param[in] error Return value of a function of PETSc.
/// @param[in] function Its name.
void check(PetscErrorCode error, const char* function);

/// @brief Owner of an object of PETSc; all ranks must take part in its end.
template <class T, PetscErrorCode (*destroy)(T*)>
class Owner
{
public:
  /// @brief Take an object over.
  explicit Owner(T object = nullptr) : _object(object) {}
  ~Owner() { destroy(&_object); }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;

  /// @brief The object.
  T get() const { return _object; }

  /// @brief Pointer for a function that creates the object.
  T* put()
  {
    destroy(&_object);
    return &_object;
  }

private:
  T _object;
};

using OwnVec = Owner<::Vec, VecDestroy>;
using OwnMat = Owner<::Mat, MatDestroy>;
using OwnKSP = Owner<::KSP, KSPDestroy>;

/// @brief Solve by one LU factorisation, that of MUMPS where PETSc has it.
void set_lu(::KSP ksp);

/// @brief A vector's values on this rank, for as long as this lives.
class Values
{
public:
  /// @brief Look at the values, which may change.
  explicit Values(::Vec x);
  ~Values() { VecRestoreArray(_x, &_values); }
  Values(const Values&) = delete;
  Values& operator=(const Values&) = delete;

  /// @brief The values.
  std::span<double> span() const { return {_values, _size}; }

private:
  ::Vec _x;
  double* _values = nullptr;
  std::size_t _size = 0;
};

/// @brief Values of a vector that does not change.
class ConstValues
{
public:
  /// @brief Look at the values.
  explicit ConstValues(::Vec x);
  ~ConstValues() { VecRestoreArrayRead(_x, &_values); }
  ConstValues(const ConstValues&) = delete;
  ConstValues& operator=(const ConstValues&) = delete;

  /// @brief The values.
  std::span<const double> span() const { return {_values, _size}; }

private:
  ::Vec _x;
  const double* _values = nullptr;
  std::size_t _size = 0;
};
} // namespace contactx_dolfinx::petsc
