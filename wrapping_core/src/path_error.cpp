#include "tautline/path_error.h"

#include <algorithm>
#include <cmath>

namespace tautline {

void Chain::build(const PathProblem& problem, const PathPose& pose,
                  const std::vector<ObstacleContact>& elementContacts) {
    contacts.clear();
    segments.clear();
    int previousElement = -1, previousContact = -1;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const bool isPoint = problem.getElement(e).isPoint();
        if (!pose.hasElement(e) || (!isPoint && !elementContacts[e].isTouched)) continue;
        const int contact = isPoint ? -1 : static_cast<int>(contacts.size());
        if (!isPoint) {
            contacts.emplace_back();
            contacts.back().element = e;
            contacts.back().start = elementContacts[e].start;
            contacts.back().segmentIn = static_cast<int>(segments.size());
        }
        if (previousElement >= 0) {
            segments.emplace_back();
            ChainSegment& segment = segments.back();
            segment.line.fromElement = previousElement, segment.line.toElement = e;
            segment.fromContact = previousContact, segment.toContact = contact;
        }
        previousElement = e, previousContact = contact;
    }
}

bool shootChain(const PathProblem& problem, const PathPose& pose, const GeodesicOptions& options, Chain& chain) {
    for (ChainContact& contact : chain.contacts) {
        problem.getElement(contact.element).surface->shootGeodesic(contact.start, options, contact.geodesic);
        if (!contact.geodesic.converged || !contact.geodesic.Q.x.allFinite() || !contact.geodesic.Q.t.allFinite())
            return false;
        const Pose& X_GS = pose.X_GE[contact.element];
        contact.P = contact.geodesic.P.reexpressedBy(X_GS);
        contact.Q = contact.geodesic.Q.reexpressedBy(X_GS);
    }
    for (ChainSegment& segment : chain.segments) {
        StraightSegment& line = segment.line;
        line.A = segment.fromContact < 0 ? pose.X_GE[line.fromElement].p : chain.contacts[segment.fromContact].Q.x;
        line.B = segment.toContact < 0 ? pose.X_GE[line.toElement].p : chain.contacts[segment.toContact].P.x;
        const Vec3 AB = line.B - line.A;
        line.length = AB.norm();
        // Coincident ends: any direction serves, the neighbouring tangent if there is one.
        if (line.length > 0)
            line.e = AB / line.length;
        else if (segment.toContact >= 0)
            line.e = chain.contacts[segment.toContact].P.t;
        else
            line.e = segment.fromContact >= 0 ? chain.contacts[segment.fromContact].Q.t : Vec3(Vec3::UnitX());
    }
    return true;
}

double calcPathError(const Chain& chain, std::vector<double>& eps) {
    eps.resize(kVariations * chain.contacts.size());
    double largest = 0;
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const ChainContact& contact = chain.contacts[i];
        const Vec3& eIn = chain.segments[contact.segmentIn].line.e;
        const Vec3& eOut = chain.segments[contact.segmentIn + 1].line.e;
        const double local[] = {eIn.dot(contact.P.N), eIn.dot(contact.P.B), eOut.dot(contact.Q.N),
                                eOut.dot(contact.Q.B)};  // Eqn. 4.3
        for (int row = 0; row < kVariations; ++row) {
            eps[kVariations * i + row] = local[row];
            largest = std::isnan(local[row]) ? kInfinity : std::max(largest, std::abs(local[row]));
        }
    }
    return largest;
}

double calcLength(const Chain& chain) {
    double length = 0;
    for (const ChainSegment& segment : chain.segments) length += segment.line.length;
    for (const ChainContact& contact : chain.contacts) length += contact.start.length;
    return length;
}

FrameVariations calcStartVariations(const DarbouxFrame& P) {
    FrameVariations d;
    d.x << P.t, P.B, Vec3::Zero(), Vec3::Zero();
    // Eqn. 4.12, 4.13 (with tauG of B = -tauG of t), 4.30, 4.45
    d.N << -P.kappaN * P.t + P.tauG * P.B, P.tauG * P.t - P.kappaB * P.B, Vec3::Zero(), Vec3::Zero();
    d.B << -P.tauG * P.N, P.kappaB * P.N, -P.t, Vec3::Zero();
    return d;
}

FrameVariations calcEndVariations(const DarbouxFrame& Q, const Geodesic& geodesic) {
    const double a = geodesic.a, aDot = geodesic.aDot, r = geodesic.r, rDot = geodesic.rDot;
    const Vec3 dN_t = -Q.kappaN * Q.t + Q.tauG * Q.B, dB_t = -Q.tauG * Q.N;
    const Vec3 dN_B = Q.tauG * Q.t - Q.kappaB * Q.B, dB_B = Q.kappaB * Q.N;
    FrameVariations d;
    d.x << Q.t, a * Q.B, r * Q.B, Q.t;
    d.N << dN_t, a * dN_B, r * dN_B, dN_t;  // Eqn. 4.12, 4.29, 4.44, 4.46
    d.B << dB_t, a * dB_B - aDot * Q.t, r * dB_B - rDot * Q.t, dB_t;
    return d;
}

namespace {

/** Writes N.de + e.dN and B.de + e.dB of one end into two rows of the band. de = sign (I - e e^T) dx / l. */
void addEndRows(const DarbouxFrame& frame, const StraightSegment& line, double sign,
                const Eigen::Matrix<double, 3, kVariations>& dx, const FrameVariations* own, int row, int col,
                BandedSolver& jacobian) {
    const double scale = line.length > 0 ? sign / line.length : 0;
    const double eN = line.e.dot(frame.N), eB = line.e.dot(frame.B);
    for (int j = 0; j < kVariations; ++j) {
        const double ex = line.e.dot(dx.col(j));
        double forN = scale * (frame.N.dot(dx.col(j)) - eN * ex);  // Eqn. 4.53 to 4.56
        double forB = scale * (frame.B.dot(dx.col(j)) - eB * ex);
        if (own) {
            forN += line.e.dot(own->N.col(j));
            forB += line.e.dot(own->B.col(j));
        }
        jacobian.upd(row, col + j) = forN;
        jacobian.upd(row + 1, col + j) = forB;
    }
}

}  // namespace

void calcPathErrorJacobian(const Chain& chain, BandedSolver& jacobian) {
    const int n = static_cast<int>(chain.contacts.size());
    jacobian.reset(kVariations * n);
    FrameVariations previousEnd;  // of the contact before, whose Q begins our incoming segment
    for (int i = 0; i < n; ++i) {
        const ChainContact& contact = chain.contacts[i];
        const ChainSegment &in = chain.segments[contact.segmentIn], &out = chain.segments[contact.segmentIn + 1];
        const FrameVariations dP = calcStartVariations(contact.P), dQ = calcEndVariations(contact.Q, contact.geodesic);
        const int row = kVariations * i;
        addEndRows(contact.P, in.line, 1, dP.x, &dP, row, row, jacobian);
        addEndRows(contact.Q, out.line, -1, dQ.x, &dQ, row + 2, row, jacobian);
        if (in.fromContact >= 0)
            addEndRows(contact.P, in.line, -1, previousEnd.x, nullptr, row, row - kVariations, jacobian);
        if (out.toContact >= 0) {
            const FrameVariations dNext = calcStartVariations(chain.contacts[i + 1].P);
            addEndRows(contact.Q, out.line, 1, dNext.x, nullptr, row + 2, row + kVariations, jacobian);
        }
        previousEnd = dQ;
    }
}

GeodesicStart calcCorrectedStart(const Surface& surface, const GeodesicStart& start, const DarbouxFrame& P_S,
                                 const Vec4& correction) {
    GeodesicStart corrected;
    corrected.point =
        surface.calcDisplacedPoint(start.point, correction[0] * P_S.t + correction[1] * P_S.B);  // Eqn. 7.22
    corrected.tangent = std::cos(correction[2]) * P_S.t + std::sin(correction[2]) * P_S.B;       // Eqn. 4.62
    corrected.length = start.length + correction[3];                                             // Eqn. 4.67
    return corrected;  // the tangent is made tangent and unit at the new point when it is shot (Eqn. 7.26)
}

}  // namespace tautline
