#include "gi/eigen_decomposition.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>

#include "engine/base/random.h"

namespace daylit {
namespace {

constexpr Eigen::Index kMoreVectors = 8;
constexpr int kSubspaceSteps = 2;

EigenDecomposition with_positive_sums(EigenDecomposition result) {
    for (auto vector : result.vectors.colwise())
        if (vector.sum() < 0.0) vector = -vector;
    return result;
}

}  // namespace

EigenDecomposition eigen_decomposition(const Eigen::MatrixXd& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
    return with_positive_sums({solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()});
}

EigenDecomposition first_eigenvectors(const Eigen::MatrixXd& positive, Eigen::Index count) {
    const Eigen::Index size = positive.rows(), kept = std::min(size, count + kMoreVectors);
    if (kept == size) return eigen_decomposition(positive);
    Eigen::MatrixXd basis(size, kept);
    Random random(1, 0, 0);
    for (double& b : basis.reshaped()) b = double(random.next()) - 0.5;
    for (int step = 0; step < kSubspaceSteps; ++step) {
        const Eigen::MatrixXd turned = positive * basis;
        basis = Eigen::HouseholderQR<Eigen::MatrixXd>(turned).householderQ() * Eigen::MatrixXd::Identity(size, kept);
    }
    const EigenDecomposition small = eigen_decomposition(basis.transpose() * positive * basis);
    return with_positive_sums({small.values, basis * small.vectors});
}

}  // namespace daylit
