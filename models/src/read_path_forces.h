// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** @name Readers of forces that pull along a path, the path included */
///@{
void readPathSpring(Element& element, const FrameTable& frames);
void readLigament(Element& element, const FrameTable& frames);
void readBlankevoortLigament(Element& element, const FrameTable& frames);
void readPathActuator(Element& element, const FrameTable& frames);
void readPrescribedTension(Element& element, const FrameTable& frames);
/** Of a force that an extension knows: extensions.h. */
void readExtensionForce(Element& element, const FrameTable& frames);
/** Of a force that is not modeled: its path is read and nothing else. */
void readPathOnly(Element& element, const FrameTable& frames);
///@}

}  // namespace tautline::models
