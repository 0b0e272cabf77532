// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/length_derivatives.h"

namespace tautline {
namespace {

using Variations = Eigen::Matrix<double, 3, kVariations>;

/** Derivative of e with respect to the place of the line's end: (I - e e^T)/l. */
Matrix3 calcDirectionDerivative(const StraightSegment& line) {
    return line.length > 0 ? Matrix3((Matrix3::Identity() - line.e * line.e.transpose()) / line.length)
                           : Matrix3(Matrix3::Zero());
}

/** Derivatives of t = N x B, one column per variation. */
Variations calcTangentVariations(const DarbouxFrame& frame, const FrameVariations& d) {
    Variations dt;
    for (int j = 0; j < kVariations; ++j) dt.col(j) = d.N.col(j).cross(frame.B) + frame.N.cross(Vector3(d.B.col(j)));
    return dt;
}

}  // namespace

void calcLengthGradient(const Chain& chain, std::vector<double>& gradient) {
    gradient.resize(kVariations * chain.contacts.size());
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const ChainContact& contact = chain.contacts[i];
        const Vector3& eIn = chain.segments[contact.segmentIn].line.e;
        const Vector3& eOut = chain.segments[contact.segmentIn + 1].line.e;
        Eigen::Map<Vector4> own(&gradient[kVariations * i]);
        own = calcStartVariations(contact.P).x.transpose() * eIn -
              calcEndVariations(contact.Q, contact.geodesic).x.transpose() * eOut + Vector4::UnitW();
    }
}

void calcLengthHessian(const Chain& chain, std::vector<LengthHessianBlocks>& hessian) {
    hessian.resize(chain.contacts.size());
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const ChainContact& contact = chain.contacts[i];
        const ShotGeodesic& geodesic = contact.geodesic;
        const ChainSegment &in = chain.segments[contact.segmentIn], &out = chain.segments[contact.segmentIn + 1];
        const FrameVariations dP = calcStartVariations(contact.P), dQ = calcEndVariations(contact.Q, geodesic);
        const Matrix3 forIn = calcDirectionDerivative(in.line), forOut = calcDirectionDerivative(out.line);
        // Row j: e . d(dx_j), with dx_P = (t, B, 0, 0) and dx_Q = (t, a B, r B, t).
        const Eigen::RowVector4d e_dtP = in.line.e.transpose() * calcTangentVariations(contact.P, dP);
        const Eigen::RowVector4d e_dBP = in.line.e.transpose() * dP.B;
        const Eigen::RowVector4d e_dtQ = out.line.e.transpose() * calcTangentVariations(contact.Q, dQ);
        const Eigen::RowVector4d e_dBQ = out.line.e.transpose() * dQ.B;
        Matrix4 bending;
        bending << e_dtP - e_dtQ, e_dBP - geodesic.a * e_dBQ, -geodesic.r * e_dBQ, -e_dtQ;
        hessian[i].own =
            dP.x.transpose() * forIn * dP.x + dQ.x.transpose() * forOut * dQ.x + 0.5 * (bending + bending.transpose());
        if (out.toContact >= 0)
            hessian[i].next = -dQ.x.transpose() * forOut * calcStartVariations(chain.contacts[i + 1].P).x;
        else
            hessian[i].next.setZero();
    }
}

}  // namespace tautline
