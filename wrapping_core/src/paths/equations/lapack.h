// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The only file that declares LAPACK routines. */
extern "C" {
/** Factors a symmetric indefinite matrix as L D L^T with pivots of one or two rows; then solves with the factor. */
void dsytrf_(const char* uplo, const int* n, double* a, const int* lda, int* ipiv, double* work, const int* lwork,
             int* info);
void dsytrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, const int* ipiv,
             double* b, const int* ldb, int* info);
}
