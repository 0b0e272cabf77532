// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <type_traits>

#include "paths/problem/posed_problem.h"

namespace tautline {

/** How the arcs on one obstacle change in number. Where the pressure on an arc turns, the string bridges a hollow:
the arc splits into two. They join again where the hollow has closed. A segment that comes down on the surface that it
has left makes one more; an arc without length is lifted.

At the very pose where a hollow opens, both arcs end where the surface does not curve along the path, and the equations
of the bridge are singular: with p the pressure's excess, a bridge is as wide as sqrt(p), its ends' error falls as p^1.5
and what it saves of the length as p^3.5. So a split is laid where the hull of the sampled arc leaves the surface, from
where Newton's method leads on; and between split and join the length has three continuous derivatives. */

/** True if the arc presses on its surface all along: kappa_n <= 0. */
bool pressesEverywhere(const Surface& surface, const ContactArc& arc);

/** Splits arcs over the hollows that their pressure shows, the first of each obstacle. @param path   solved
@return whether there was one */
bool splitArcs(const PosedProblem& scene, PathSolution& path);

/** Joins neighboring arcs of one obstacle of which the hollow between is closed. @param path   solved
@return whether there were any */
bool joinArcs(const PosedProblem& scene, PathSolution& path);

/** Joins the two neighboring arcs of one obstacle that are nearest to each other, for a contact set that has no path.
@param path   with segments. @return false if no obstacle has several */
bool joinNearestArcs(const PosedProblem& scene, PathSolution& path);

/** One arc or more where a segment passes below the surface that it has left, or comes to. */
void touchAgain(const PosedProblem& scene, int element, int segment, PathSolution& path);

/** Takes one arc of a touched obstacle out of contact. */
void liftArc(int arc, ObstacleContact& contact);

/** Calls visit(arc) for all arcs in path order. */
template <class Contacts, class Visitor>
void forEachArc(Contacts& contacts, Visitor visit) {
    for (auto& contact : contacts)
        for (int i = 0; i < contact.getNumArcs(); ++i) {
            if constexpr (std::is_const_v<Contacts>)
                visit(contact.getArc(i));
            else
                visit(contact.updArc(i));
        }
}

}  // namespace tautline
