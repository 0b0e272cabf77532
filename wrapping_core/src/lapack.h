#pragma once
/** The only file that declares LAPACK routines. */
extern "C" {
/** Factors a general band matrix with partial pivoting and solves for nrhs right-hand sides. */
void dgbsv_(const int* n, const int* kl, const int* ku, const int* nrhs, double* ab, const int* ldab, int* ipiv,
            double* b, const int* ldb, int* info);
}
