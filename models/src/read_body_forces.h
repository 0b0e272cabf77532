// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame_table.h"

namespace tautline::models {

/** @name Readers of forces without a path */
///@{
void readCoordinateLimitForce(Element& element, const FrameTable& frames);
void readCoordinateSpring(Element& element, const FrameTable& frames);
void readBushing(Element& element, const FrameTable& frames);
void readPointToPointSpring(Element& element, const FrameTable& frames);
void readCoordinateActuator(Element& element, const FrameTable& frames);
void readHuntCrossley(Element& element, const FrameTable& frames);
void readSmoothSphere(Element& element, const FrameTable& frames);
///@}

}  // namespace tautline::models
