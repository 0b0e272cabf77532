// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/chain.h"

namespace tautline {
namespace {

/** Whether the geodesic of a contact is the one that would be shot from its start. */
bool isShotFromStart(const ContactArc& contact, const Surface& surface, const ShootingOptions& options) {
    const ShotGeodesic& arc = contact.geodesic;
    return contact.shot.surface == surface.getId() && contact.shot.accuracy == options.accuracy && arc.converged &&
           arc.length == contact.start.length && arc.P.x == contact.start.point.p && arc.P.t == contact.start.tangent;
}

/** The arcs' end frames in ground and the straight segments. @return false if a geodesic did not come to its end or a
number is not finite */
bool layChain(const PathPose& pose, Chain& chain) {
    bool isFinite = true;
    for (ChainContact& contact : chain.contacts) {
        const ShotGeodesic& geodesic = contact.geodesic;
        isFinite = isFinite && geodesic.converged && geodesic.Q.x.allFinite() && geodesic.Q.t.allFinite();
        const Pose& X_GS = pose.X_GE[contact.element];
        contact.P = geodesic.P.reexpressedBy(X_GS);
        contact.Q = geodesic.Q.reexpressedBy(X_GS);
    }
    for (ChainSegment& segment : chain.segments) {
        StraightSegment& line = segment.line;
        line.A = segment.fromContact < 0 ? pose.X_GE[line.fromElement].p : chain.contacts[segment.fromContact].Q.x;
        line.B = segment.toContact < 0 ? pose.X_GE[line.toElement].p : chain.contacts[segment.toContact].P.x;
        const Vector3 AB = line.B - line.A;
        line.length = AB.norm();
        // Coincident ends: any direction serves, the neighbouring tangent if there is one.
        if (line.length > 0)
            line.e = AB / line.length;
        else if (segment.toContact >= 0)
            line.e = chain.contacts[segment.toContact].P.t;
        else
            line.e = segment.fromContact >= 0 ? chain.contacts[segment.fromContact].Q.t : Vector3(Vector3::UnitX());
    }
    return isFinite;
}

/** The next of entries that are used again as they stand. */
template <class Entry>
Entry& useNext(std::vector<Entry>& entries, std::size_t& numUsed) {
    if (numUsed == entries.size()) entries.emplace_back();
    return entries[numUsed++];
}

}  // namespace

void Chain::build(const PathProblem& problem, const PathPose& pose,
                  const std::vector<ObstacleContact>& elementContacts) {
    // shootChain() sets all that is not set here.
    std::size_t numContacts = 0, numSegments = 0;
    int previousElement = -1, previousArc = 0, previousContact = -1;
    const auto goTo = [&](int element, int arc, int contact) {
        if (previousElement >= 0) {
            ChainSegment& added = useNext(segments, numSegments);
            added.line.fromElement = previousElement, added.line.toElement = element;
            added.line.fromArc = previousArc, added.line.toArc = arc;
            added.fromContact = previousContact, added.toContact = contact;
        }
        previousElement = element, previousArc = arc, previousContact = contact;
    };
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (!pose.hasElement(e)) continue;
        if (problem.getElement(e).isPoint()) goTo(e, 0, -1);
        for (int arc = 0; arc < elementContacts[e].getNumArcs(); ++arc) {
            ChainContact& added = useNext(contacts, numContacts);
            added.element = e, added.arc = arc;
            added.start = elementContacts[e].getArc(arc).start;
            added.segmentIn = static_cast<int>(numSegments);
            goTo(e, arc, static_cast<int>(numContacts) - 1);
        }
    }
    contacts.resize(numContacts);
    segments.resize(numSegments);
}

bool shootChain(const PathProblem& problem, const PathPose& pose, const ShootingOptions& options, Chain& chain) {
    for (ChainContact& contact : chain.contacts)
        problem.getElement(contact.element).surface->shootGeodesic(contact.start, options, contact.geodesic);
    return layChain(pose, chain);
}

bool shootUnknownArcs(const PathProblem& problem, const PathPose& pose, const ShootingOptions& options,
                      const std::vector<ObstacleContact>& elementContacts, Chain& chain, int& numShots) {
    numShots = 0;
    for (ChainContact& contact : chain.contacts) {
        const Surface& surface = *problem.getElement(contact.element).surface;
        const ContactArc& known = elementContacts[contact.element].getArc(contact.arc);
        if (isShotFromStart(known, surface, options)) {
            contact.geodesic = known.geodesic;
        } else {
            surface.shootGeodesic(contact.start, options, contact.geodesic);
            ++numShots;
        }
    }
    return layChain(pose, chain);
}

double calcLength(const Chain& chain) {
    double length = 0;
    for (const ChainSegment& segment : chain.segments) length += segment.line.length;
    for (const ChainContact& contact : chain.contacts) length += contact.start.length;
    return length;
}

}  // namespace tautline
