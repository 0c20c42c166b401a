// SPDX-License-Identifier: MIT
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <benchmark/boomeramg.hpp>
#include <cstddef>
#include <vector>

namespace vantage {
namespace {

struct Session {
  Session() {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    HYPRE_Finalize();
    MPI_Finalize();
  }
};

}  // namespace

struct BoomerAmg::State {
  HYPRE_IJMatrix matrix = nullptr;
  HYPRE_IJVector right = nullptr;
  HYPRE_IJVector unknown = nullptr;
  HYPRE_Int size = 0;
};

BoomerAmg::BoomerAmg(const LaplaceMatrix& system) : state_(std::make_unique<State>()) {
  static const Session session;
  const auto size = static_cast<HYPRE_Int>(system.matrix.rows());
  state_->size = size;
  HYPRE_IJMatrixCreate(MPI_COMM_WORLD, 0, size - 1, 0, size - 1, &state_->matrix);
  HYPRE_IJMatrixSetObjectType(state_->matrix, HYPRE_PARCSR);
  HYPRE_IJMatrixInitialize(state_->matrix);
  for (HYPRE_Int row = 0; row < size; ++row) {
    std::vector<HYPRE_BigInt> columns;
    std::vector<double> values;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(system.matrix, row); entry; ++entry) {
      columns.push_back(static_cast<HYPRE_BigInt>(entry.index()));
      values.push_back(entry.value());
    }
    auto count = static_cast<HYPRE_Int>(columns.size());
    const HYPRE_BigInt number = row;
    HYPRE_IJMatrixSetValues(state_->matrix, 1, &count, &number, columns.data(), values.data());
  }
  HYPRE_IJMatrixAssemble(state_->matrix);
  for (HYPRE_IJVector* vector : {&state_->right, &state_->unknown}) {
    HYPRE_IJVectorCreate(MPI_COMM_WORLD, 0, size - 1, vector);
    HYPRE_IJVectorSetObjectType(*vector, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(*vector);
    for (HYPRE_BigInt row = 0; row < size; ++row) {
      const double value = vector == &state_->right ? system.right(row) : 0.0;
      HYPRE_IJVectorSetValues(*vector, 1, &row, &value);
    }
    HYPRE_IJVectorAssemble(*vector);
  }
}

BoomerAmg::~BoomerAmg() {
  HYPRE_IJMatrixDestroy(state_->matrix);
  HYPRE_IJVectorDestroy(state_->right);
  HYPRE_IJVectorDestroy(state_->unknown);
}

int BoomerAmg::solve(double tolerance) {
  void* object = nullptr;
  HYPRE_IJMatrixGetObject(state_->matrix, &object);
  const auto matrix = static_cast<HYPRE_ParCSRMatrix>(object);
  HYPRE_IJVectorGetObject(state_->right, &object);
  const auto right = static_cast<HYPRE_ParVector>(object);
  HYPRE_IJVectorGetObject(state_->unknown, &object);
  const auto unknown = static_cast<HYPRE_ParVector>(object);
  HYPRE_ParVectorSetConstantValues(unknown, 0.0);

  HYPRE_Solver gradients = nullptr;
  HYPRE_ParCSRPCGCreate(MPI_COMM_WORLD, &gradients);
  HYPRE_PCGSetMaxIter(gradients, 500);
  HYPRE_PCGSetTol(gradients, tolerance);
  HYPRE_PCGSetTwoNorm(gradients, 1);
  HYPRE_Solver amg = nullptr;
  HYPRE_BoomerAMGCreate(&amg);
  HYPRE_BoomerAMGSetCoarsenType(amg, 10);  // HMIS
  HYPRE_BoomerAMGSetInterpType(amg, 6);    // extended + i
  HYPRE_BoomerAMGSetPMaxElmts(amg, 4);
  HYPRE_BoomerAMGSetStrongThreshold(amg, 0.5);  // for three dimensions
  HYPRE_BoomerAMGSetAggNumLevels(amg, 1);
  HYPRE_BoomerAMGSetRelaxType(amg, 8);  // symmetric Gauss-Seidel
  HYPRE_BoomerAMGSetMaxIter(amg, 1);
  HYPRE_BoomerAMGSetTol(amg, 0.0);
  HYPRE_ParCSRPCGSetPrecond(gradients, HYPRE_BoomerAMGSolve, HYPRE_BoomerAMGSetup, amg);
  HYPRE_ParCSRPCGSetup(gradients, matrix, right, unknown);
  HYPRE_ParCSRPCGSolve(gradients, matrix, right, unknown);
  HYPRE_Int iterations = 0;
  HYPRE_PCGGetNumIterations(gradients, &iterations);
  HYPRE_ParCSRPCGDestroy(gradients);
  HYPRE_BoomerAMGDestroy(amg);
  return static_cast<int>(iterations);
}

}  // namespace vantage
