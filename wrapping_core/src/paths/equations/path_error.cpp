// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/path_error.h"

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

/** The unit vector e of a segment seen from the end of an arc that it meets there, and 1/l, 0 where l is. */
struct SegmentEnd {
    double et = kNaN, eN = kNaN, eB = kNaN, inverseLength = kNaN;
};

SegmentEnd calcSegmentEnd(const StraightSegment& line, const DarbouxFrame& end) {
    return {line.e.dot(end.t), line.e.dot(end.N), line.e.dot(end.B), line.length > 0 ? 1 / line.length : 0};
}

/** Derivatives of (e.N, e.B) at one end of an arc by the moves of a contact point along its t and B. */
struct MoveDerivatives {
    double N_t, N_B, B_t, B_B;
};

/** By the moves of that end itself: N.de + e.dN and B.de + e.dB with de = sign (I - e e^T) dx / l (Eqn. 4.53, 4.56),
sign = 1 at P and -1 at Q, in components along the orthonormal trihedron. */
MoveDerivatives calcOwnDerivatives(const DarbouxFrame& end, const SegmentEnd& seen, double sign) {
    const double s = sign * seen.inverseLength, et = seen.et, eN = seen.eN, eB = seen.eB;
    return {-s * eN * et - end.kappaN * et + end.tauG * eB, -s * eN * eB + end.tauG * et - end.kappaB * eB,
            -s * eB * et - end.tauG * eN, s * (1 - eB * eB) + end.kappaB * eN};
}

/** By the moves of the segment's other end: N.de and B.de alone (Eqn. 4.54, 4.55). */
MoveDerivatives calcOtherDerivatives(const DarbouxFrame& end, const SegmentEnd& seen, const DarbouxFrame& otherEnd,
                                     const SegmentEnd& seenThere, double sign) {
    const double s = sign * seen.inverseLength;
    return {s * (end.N.dot(otherEnd.t) - seen.eN * seenThere.et), s * (end.N.dot(otherEnd.B) - seen.eN * seenThere.eB),
            s * (end.B.dot(otherEnd.t) - seen.eB * seenThere.et), s * (end.B.dot(otherEnd.B) - seen.eB * seenThere.eB)};
}

/** The columns of an arc whose start P moves, along t and B: two rows. */
void setStartColumns(const MoveDerivatives& d, double* rowN, double* rowB) {
    rowN[0] = d.N_t, rowN[1] = d.N_B;
    rowB[0] = d.B_t, rowB[1] = d.B_B;
}

/** The columns of an arc whose end Q moves, along t and, by the Jacobi fields, along B: two rows. */
void setEndColumns(const MoveDerivatives& d, const ShotGeodesic& geodesic, double* rowN, double* rowB) {
    rowN[0] = d.N_t, rowN[1] = geodesic.a * d.N_B, rowN[2] = geodesic.r * d.N_B, rowN[3] = d.N_t;
    rowB[0] = d.B_t, rowB[1] = geodesic.a * d.B_B, rowB[2] = geodesic.r * d.B_B, rowB[3] = d.B_t;
}

}  // namespace

double calcPathError(const Chain& chain, std::vector<double>& eps) {
    eps.resize(kVariations * chain.contacts.size());
    double largest = 0;
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const ChainContact& contact = chain.contacts[i];
        const Vector3& eIn = chain.segments[contact.segmentIn].line.e;
        const Vector3& eOut = chain.segments[contact.segmentIn + 1].line.e;
        const double local[] = {eIn.dot(contact.P.N), eIn.dot(contact.P.B), eOut.dot(contact.Q.N),
                                eOut.dot(contact.Q.B)};  // Eqn. 4.3
        for (int row = 0; row < kVariations; ++row) {
            eps[kVariations * i + row] = local[row];
            largest = std::isnan(local[row]) ? kInfinity : std::max(largest, std::abs(local[row]));
        }
    }
    return largest;
}

void calcPathErrorJacobian(const Chain& chain, PathJacobian& jacobian) {
    constexpr int kNext = kVariations;  // where a row of Q holds the next contact's columns
    const int n = static_cast<int>(chain.contacts.size());
    jacobian.reset(kVariations * n);
    SegmentEnd atP;
    for (int i = 0; i < n; ++i) {
        const ChainContact& contact = chain.contacts[i];
        const ShotGeodesic& geodesic = contact.geodesic;
        const ChainSegment &in = chain.segments[contact.segmentIn], &out = chain.segments[contact.segmentIn + 1];
        if (in.fromContact < 0) atP = calcSegmentEnd(in.line, contact.P);
        const SegmentEnd atQ = calcSegmentEnd(out.line, contact.Q);
        double* rows[kVariations];
        for (int row = 0; row < kVariations; ++row) rows[row] = jacobian.updRow(kVariations * i + row);
        double *ownN = rows[0] + PathJacobian::kOwnColumns, *ownB = rows[1] + PathJacobian::kOwnColumns;
        setStartColumns(calcOwnDerivatives(contact.P, atP, 1), ownN, ownB);
        ownB[2] = -atP.et;  // Eqn. 4.45
        setEndColumns(calcOwnDerivatives(contact.Q, atQ, -1), geodesic, rows[2], rows[3]);
        rows[3][1] -= geodesic.aDot * atQ.et;  // Eqn. 4.29
        rows[3][2] -= geodesic.rDot * atQ.et;  // Eqn. 4.44
        if (out.toContact < 0) continue;
        const ChainContact& next = chain.contacts[i + 1];
        const SegmentEnd atNext = calcSegmentEnd(out.line, next.P);
        setStartColumns(calcOtherDerivatives(contact.Q, atQ, next.P, atNext, 1), rows[2] + kNext, rows[3] + kNext);
        setEndColumns(calcOtherDerivatives(next.P, atNext, contact.Q, atQ, -1), geodesic,
                      jacobian.updRow(kVariations * (i + 1)), jacobian.updRow(kVariations * (i + 1) + 1));
        atP = atNext;
    }
}

}  // namespace tautline
