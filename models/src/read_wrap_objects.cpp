// SPDX-License-Identifier: Apache-2.0
#include "read_wrap_objects.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>

#include "tautline/error.h"
#include "tautline/models/extensions.h"
#include "tautline/surfaces/patch_fit.h"
#include "tautline/surfaces/scaled_surface.h"
#include "tautline/surfaces/solid_file.h"

namespace tautline::models {
namespace {

constexpr int kMostCounts = 1000;  ///< control points of a patch along a side

Quadrant readQuadrant(Element& element) {
    static const std::map<std::string, Quadrant> kQuadrants{
        {"", Quadrant::All},      {"all", Quadrant::All},   {"unassigned", Quadrant::All}, {"x", Quadrant::PlusX},
        {"+x", Quadrant::PlusX},  {"-x", Quadrant::MinusX}, {"y", Quadrant::PlusY},        {"+y", Quadrant::PlusY},
        {"-y", Quadrant::MinusY}, {"z", Quadrant::PlusZ},   {"+z", Quadrant::PlusZ},       {"-z", Quadrant::MinusZ}};
    const Element child = element.find("quadrant");
    if (!child) return Quadrant::All;
    std::string text = child.getText();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto found = kQuadrants.find(text);
    if (found == kQuadrants.end()) child.fail("unknown quadrant '" + child.getText() + "' of " + element.describe());
    return found->second;
}

EllipsoidShape readEllipsoid(Element& element) {
    const Element dimensions = element.require("dimensions");
    const EllipsoidShape shape{dimensions.getVec3()};
    for (double semiAxis : shape.semiAxes) {
        if (semiAxis <= 0.0) {
            dimensions.fail("dimensions of " + element.describe() + " are " + dimensions.getText() +
                            ", not all positive");
        }
    }
    return shape;
}

TorusShape readTorus(Element& element) {
    const TorusShape shape{element.requirePositive("inner_radius"), element.requirePositive("outer_radius")};
    if (shape.tubeRadius >= shape.ringRadius) element.fail(element.describe() + " has no hole");
    return shape;
}

ParaboloidShape readParaboloid(Element& element) {
    return {element.requirePositive("a"), element.requirePositive("b")};
}

EllipticTorusShape readEllipticTorus(Element& element) {
    const EllipticTorusShape shape{element.requirePositive("ring_radius"), element.requirePositive("radial_semi_axis"),
                                   element.requirePositive("axial_semi_axis")};
    if (shape.radialSemiAxis >= shape.ringRadius) element.fail(element.describe() + " has no hole");
    return shape;
}

SurfaceForm readForm(Element& element) {
    const Element child = element.find("tautline_form");
    if (!child || child.getText() == "implicit") return SurfaceForm::Implicit;
    if (child.getText() != "parametric") {
        child.fail("unknown tautline_form '" + child.getText() + "' of " + element.describe() +
                   ": implicit or parametric");
    }
    return SurfaceForm::Parametric;
}

CylinderShape readCylinder(Element& element) {
    return {element.requirePositive("radius"), element.requirePositive("length")};
}

SphereShape readSphere(Element& element) {
    return {element.requirePositive("radius")};
}

/** Of a file that `tautline fit` has written, scaled as a Mesh is. It is looked for beside the model. */
MeshShape readMesh(Element& element) {
    const Element file = element.require("solid_file");
    const Vector3 factors = element.getVec3Or("scale_factors", Vector3::Ones());
    if (!(factors.minCoeff() > 0))
        element.require("scale_factors").fail("scale_factors of " + element.describe() + " must be positive");
    const std::filesystem::path model = element.updReading().model.fileName;
    try {
        const auto solid = std::make_shared<BSplineSolid>(readSolidFile(model.parent_path() / file.getText()));
        if (factors == Vector3::Ones()) return {solid};
        return {makeScaledSurface(solid, Matrix3(factors.asDiagonal()))};
    } catch (const InvalidInput& refused) {
        file.fail(refused.what());
    }
}

/** Two whole numbers. */
std::array<int, 2> readCounts(const Element& element) {
    const std::vector<double> numbers = element.getNumbers(2);
    for (const double number : numbers)
        if (!(number >= 1 && number <= kMostCounts && number == std::floor(number)))
            element.fail(element.describe() + " are " + element.getText() + ", not whole numbers from 1 to " +
                         std::to_string(kMostCounts));
    return {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

/** As many as there are rows and columns, row by row. */
Eigen::MatrixXd readHeights(const Element& element, int rows, int columns) {
    const std::vector<double> numbers = element.getNumbers(static_cast<std::size_t>(rows) * columns);
    Eigen::MatrixXd heights(rows, columns);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) heights(i, j) = numbers[static_cast<std::size_t>(i * columns + j)];
    return heights;
}

/** Heights over the xy plane of the wrap object: a polynomial in coordinates scaled to [-1, 1], or B-splines. */
MeshShape readPatch(Element& element) {
    const Element heights = element.require("heights"), orders = element.find("orders"),
                  controls = element.find("control_points");
    const std::vector<double> limits = element.require("domain").getNumbers(4);
    const ParameterDomain domain{Vector2(limits[0], limits[2]), Vector2(limits[1], limits[3])};
    if (bool(orders) == bool(controls)) element.fail(element.describe() + " has either orders or control_points");
    try {
        const auto [numU, numV] = readCounts(orders ? orders : controls);
        if (controls)
            return {std::make_shared<BSplinePatch>(
                BSplinePatch::makeHeightPatch(domain, readHeights(heights, numU, numV)))};
        return {std::make_shared<PolynomialPatch>(
            PolynomialPatch::makeScaledHeightPatch(domain, readHeights(heights, numU + 1, numV + 1)))};
    } catch (const InvalidInput& refused) {
        element.fail(refused.what());
    }
}

using ShapeReader = WrapShape (*)(Element&);

/** A reader of one shape as one of any. */
template <auto read>
WrapShape readAs(Element& element) {
    return read(element);
}

const std::map<std::string, ShapeReader>& getShapeReaders() {
    static const std::map<std::string, ShapeReader> kReaders{{"WrapCylinder", readAs<readCylinder>},
                                                             {"WrapSphere", readAs<readSphere>},
                                                             {"WrapEllipsoid", readAs<readEllipsoid>},
                                                             {"WrapTorus", readAs<readTorus>},
                                                             {"TautlineWrapParaboloid", readAs<readParaboloid>},
                                                             {"TautlineWrapEllipticTorus", readAs<readEllipticTorus>},
                                                             {"TautlineWrapMesh", readAs<readMesh>},
                                                             {"TautlineWrapPatch", readAs<readPatch>}};
    return kReaders;
}

ExtensionShape readExtension(Element& element, const SurfaceReader& read) {
    ElementProperties properties(element);
    try {
        const std::shared_ptr<const Surface> surface = read(properties);
        require(surface != nullptr, "its extension has made no surface");
        return {surface};
    } catch (const InvalidInput& refused) {
        properties.fail(refused.what());
    }
}

/** False for a shape that nobody knows. */
bool readShape(Element& element, WrapObject& wrap) {
    const auto reader = getShapeReaders().find(element.getTag());
    if (reader != getShapeReaders().end()) {
        wrap.shape = reader->second(element);
        wrap.form = readForm(element);
        return true;
    }
    const SurfaceReader* extension = updExtensions().findSurface(element.getTag());
    if (extension) wrap.shape = readExtension(element, *extension);
    return extension != nullptr;
}

void checkUnique(const Element& element, const WrapObject& wrap, const ModelDescription& model) {
    for (const WrapObject& other : model.wrapObjects)
        if (other.name == wrap.name && other.body == wrap.body)
            element.fail("a second wrap object '" + wrap.name + "' of body '" + wrap.body + "'");
}

void readWrapObject(Element element, const BodyFrame& owner) {
    WrapObject wrap;
    if (!readShape(element, wrap)) return element.refuse("wrap object", Effect::Motion);
    wrap.name = element.getRequiredName();
    wrap.line = element.findLine();
    wrap.body = owner.body;
    const Vector3 translation = element.getVec3Or("translation", Vector3::Zero());
    const Vector3 rotation = element.getVec3Or("xyz_body_rotation", Vector3::Zero());
    wrap.X_BW = owner.X_BF * makePose(translation, rotation);
    wrap.quadrant = readQuadrant(element);
    wrap.active = element.getBoolOr("active", true);
    element.skip({"Appearance", "VisibleObject", "display_preference", "color", "FrameGeometry", "attached_geometry"},
                 "only drawn");
    element.refuseUnknown();
    auto& model = element.updReading().model;
    checkUnique(element, wrap, model);
    model.wrapObjects.push_back(wrap);
}

}  // namespace

bool isWrapObjectType(const std::string& tag) {
    return getShapeReaders().count(tag) > 0;
}

void readWrapObjects(const BodyParts& parts) {
    for (const FrameElement& owner : parts.wrapOwners) {
        Element element = owner.element;
        Element set = element.find("WrapObjectSet");
        if (!set) continue;
        for (const Element& wrap : set.getSetMembers()) readWrapObject(wrap, parts.frames.resolvePath(owner.path));
    }
}

}  // namespace tautline::models
