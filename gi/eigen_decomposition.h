#pragma once
// Eigenvectors of symmetric matrices, largest eigenvalue first. Behind one door, as the solver's templates take longer
// to compile than all that calls them.
#include <Eigen/Core>

namespace daylit {

struct EigenDecomposition {
    Eigen::VectorXd values;   // descending; of a positive matrix, those near zero may come out negative
    Eigen::MatrixXd vectors;  // columns, of length 1, the sum of each not negative: the solver's signs are chance
};

/// All eigenvectors of a symmetric matrix, of which the lower triangle is read.
EigenDecomposition eigen_decomposition(const Eigen::MatrixXd& symmetric);

/// The first eigenvectors of a symmetric positive matrix, as many as are asked for and a few of lesser precision
/// beyond, by subspace iteration (Halko, Martinsson and Tropp 2011, 4.5): all of them take many times as long.
EigenDecomposition first_eigenvectors(const Eigen::MatrixXd& positive, Eigen::Index count);

}  // namespace daylit
