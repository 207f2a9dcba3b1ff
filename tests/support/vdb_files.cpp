// VDB files made with OpenVDB itself, to be read through the volume room.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/vdb_files.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>

namespace eikonal::volume {

struct VdbGrid::Impl {
    openvdb::GridBase::Ptr grid;
};

namespace {

openvdb::Coord coordOf(const glm::ivec3& p) {
    return {p.x, p.y, p.z};
}

openvdb::Vec3d vectorOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

void toValue(const glm::dvec3& from, openvdb::Vec3s& to) {
    to = openvdb::Vec3s(vectorOf(from));
}
template<typename T> void toValue(const glm::dvec3& from, T& to) {
    to = static_cast<T>(from.x);
}

glm::dvec3 fromValue(const openvdb::Vec3s& from) {
    return {from.x(), from.y(), from.z()};
}
template<typename T> glm::dvec3 fromValue(const T& from) {
    return glm::dvec3(static_cast<double>(from));
}

using Grids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid,
                                openvdb::BoolGrid, openvdb::Vec3SGrid>;

/// Calls `act` with the grid as what it is.
template<typename Act> void visit(openvdb::GridBase& grid, const Act& act) {
    if (!grid.apply<Grids>(act)) throw std::runtime_error("a grid of another type: " + grid.type());
}

// By OpenVDB's own list of types: a call of GridT::create() would compile every virtual function of
// the grid and its tree here once more, some seconds for each type.
openvdb::GridBase::Ptr made(VdbGrid::Type type, const glm::dvec3& background) {
    openvdb::initialize();
    const char* name = type == VdbGrid::Type::float64   ? "double"
                       : type == VdbGrid::Type::int32   ? "int32"
                       : type == VdbGrid::Type::boolean ? "bool"
                       : type == VdbGrid::Type::vector  ? "vec3s"
                                                        : "float";
    openvdb::GridBase::Ptr grid =
        openvdb::GridBase::createGrid("Tree_" + std::string(name) + "_5_4_3");
    visit(*grid, [&](auto& known) {
        typename std::decay_t<decltype(known)>::ValueType value{};
        toValue(background, value);
        known.tree().root().setBackground(value, false);
    });
    return grid;
}

void insert(openvdb::MetaMap& map, const std::string& key, const VdbMeta& value) {
    std::visit(
        [&](const auto& held) {
            using T = std::decay_t<decltype(held)>;
            map.insertMeta(key, openvdb::TypedMetadata<T>(held));
        },
        value);
}

template<typename T>
bool tryRead(const openvdb::MetaMap& map, const std::string& key, VdbMeta& value) {
    const auto found = map.getMetadata<openvdb::TypedMetadata<T>>(key);
    if (found) value = found->value();
    return found != nullptr;
}

VdbMeta read(const openvdb::MetaMap& map, const std::string& key) {
    VdbMeta value;
    if (!tryRead<std::string>(map, key, value) && !tryRead<float>(map, key, value) &&
        !tryRead<double>(map, key, value) && !tryRead<std::int32_t>(map, key, value) &&
        !tryRead<std::int64_t>(map, key, value))
        throw std::runtime_error("no metadata '" + key + "' of a type that is known");
    return value;
}

} // namespace

VdbGrid::VdbGrid(const std::string& name, Type type, const glm::dvec3& background)
    : mImpl(std::make_shared<Impl>(Impl{made(type, background)})) {
    mImpl->grid->setName(name);
}

VdbGrid::VdbGrid(std::shared_ptr<Impl> impl) : mImpl(std::move(impl)) {}

VdbGrid VdbGrid::sharing(const std::string& name) const {
    VdbGrid other(std::make_shared<Impl>(Impl{mImpl->grid->copyGrid()}));
    other.mImpl->grid->setName(name);
    return other;
}

void VdbGrid::set(const glm::ivec3& voxel, const glm::dvec3& value) {
    visit(*mImpl->grid, [&](auto& grid) {
        typename std::decay_t<decltype(grid)>::ValueType held{};
        toValue(value, held);
        grid.tree().setValueOn(coordOf(voxel), held);
    });
}

void VdbGrid::fill(const IndexBox& box, const glm::dvec3& value, bool active) {
    visit(*mImpl->grid, [&](auto& grid) {
        typename std::decay_t<decltype(grid)>::ValueType held{};
        toValue(value, held);
        grid.fill({coordOf(box.min), coordOf(box.max)}, held, active);
    });
}

glm::dvec3 VdbGrid::at(const glm::ivec3& voxel) const {
    glm::dvec3 value(0);
    visit(*mImpl->grid,
          [&](const auto& grid) { value = fromValue(grid.tree().getValue(coordOf(voxel))); });
    return value;
}

bool VdbGrid::isActive(const glm::ivec3& voxel) const {
    bool active = false;
    visit(*mImpl->grid, [&](const auto& grid) { active = grid.tree().isValueOn(coordOf(voxel)); });
    return active;
}

std::uint64_t VdbGrid::activeVoxels() const {
    return mImpl->grid->activeVoxelCount();
}

double VdbGrid::background() const {
    double value = 0;
    visit(*mImpl->grid, [&](const auto& grid) { value = fromValue(grid.background()).x; });
    return value;
}

bool VdbGrid::hasTopologyOf(const VdbGrid& other) const {
    bool same = false;
    visit(*mImpl->grid, [&](const auto& grid) {
        const auto theirs = openvdb::gridConstPtrCast<std::decay_t<decltype(grid)>>(
            openvdb::GridBase::ConstPtr(other.mImpl->grid));
        same = theirs && grid.tree().hasSameTopology(theirs->tree());
    });
    return same;
}

bool VdbGrid::isInside(const glm::ivec3& voxel) const {
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(mImpl->grid);
    return openvdb::tools::sdfInteriorMask(*grid)->tree().isValueOn(coordOf(voxel));
}

std::string VdbGrid::name() const {
    return mImpl->grid->getName();
}

std::string VdbGrid::type() const {
    return mImpl->grid->valueType();
}

void VdbGrid::setLevelSet() {
    mImpl->grid->setGridClass(openvdb::GRID_LEVEL_SET);
}

bool VdbGrid::isLevelSet() const {
    return mImpl->grid->getGridClass() == openvdb::GRID_LEVEL_SET;
}

void VdbGrid::setFogVolume() {
    mImpl->grid->setGridClass(openvdb::GRID_FOG_VOLUME);
}

std::string VdbGrid::gridClass() const {
    return openvdb::GridBase::gridClassToString(mImpl->grid->getGridClass());
}

void VdbGrid::setHalf() {
    mImpl->grid->setSaveFloatAsHalf(true);
}

bool VdbGrid::isHalf() const {
    return mImpl->grid->saveFloatAsHalf();
}

void VdbGrid::setCovariant() {
    mImpl->grid->setVectorType(openvdb::VEC_COVARIANT);
}

bool VdbGrid::isCovariant() const {
    return mImpl->grid->getVectorType() == openvdb::VEC_COVARIANT;
}

void VdbGrid::setCreator(const std::string& creator) {
    mImpl->grid->setCreator(creator);
}

std::string VdbGrid::creator() const {
    return mImpl->grid->getCreator();
}

void VdbGrid::setMeta(const std::string& key, const VdbMeta& value) {
    insert(*mImpl->grid, key, value);
}

VdbMeta VdbGrid::meta(const std::string& key) const {
    return read(*mImpl->grid, key);
}

void VdbGrid::setVoxelSize(double size) {
    mImpl->grid->setTransform(openvdb::math::Transform::createLinearTransform(size));
}

void VdbGrid::translate(const glm::dvec3& by) {
    mImpl->grid->transform().postTranslate(vectorOf(by));
}

void VdbGrid::preScale(const glm::dvec3& by) {
    mImpl->grid->transform().preScale(vectorOf(by));
}

void VdbGrid::setWorldFromIndex(const glm::dmat4& matrix) {
    // OpenVDB multiplies rows from the left: its rows are GLM's columns.
    mImpl->grid->setTransform(
        openvdb::math::Transform::createLinearTransform(openvdb::math::Mat4d(&matrix[0][0])));
}

void VdbGrid::setFrustum() {
    mImpl->grid->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd({0, 0, 0}, {8, 8, 8}), 0.5, 1, 0.1));
}

glm::dvec3 VdbGrid::worldFromIndex(const glm::dvec3& voxel) const {
    const openvdb::Vec3d world = mImpl->grid->transform().indexToWorld(vectorOf(voxel));
    return {world.x(), world.y(), world.z()};
}

VdbGrid VolumeTest::block(const std::string& name, VdbGrid::Type type, const glm::dvec3& value,
                          const glm::dvec3& background) {
    VdbGrid grid(name, type, background);
    grid.fill({glm::ivec3(0), glm::ivec3(7)}, value);
    return grid;
}

VdbGrid VolumeTest::floats(const std::string& name, float value, float background) {
    return block(name, VdbGrid::Type::float32, glm::dvec3(value), glm::dvec3(background));
}

VdbGrid VolumeTest::vectors(const std::string& name, const glm::dvec3& value) {
    return block(name, VdbGrid::Type::vector, value, glm::dvec3(0));
}

VdbGrid VolumeTest::emptyFloats(const std::string& name, float background) {
    return {name, VdbGrid::Type::float32, glm::dvec3(background)};
}

std::string VolumeTest::vdb(const std::string& name, const std::vector<VdbGrid>& grids,
                            const std::map<std::string, VdbMeta>& metadata, bool statistics) const {
    openvdb::initialize();
    openvdb::GridPtrVec all;
    for (const VdbGrid& grid : grids) all.push_back(grid.impl().grid);
    openvdb::MetaMap map;
    for (const auto& [key, value] : metadata) insert(map, key, value);
    openvdb::io::File file(at(name));
    file.setGridStatsMetadataEnabled(statistics);
    file.write(all, map);
    file.close();
    return at(name);
}

std::string VolumeTest::write(const Volume& volume, const std::string& name,
                              const History& history) const {
    AtomicFile out(at(name));
    volume.write(out, history);
    out.commit();
    return at(name);
}

VdbGrid VolumeTest::gridIn(const std::string& name, const std::string& grid) const {
    openvdb::initialize();
    openvdb::io::File file(at(name));
    file.open(false);
    return VdbGrid(std::make_shared<VdbGrid::Impl>(VdbGrid::Impl{file.readGrid(grid)}));
}

VdbMeta VolumeTest::metaIn(const std::string& name, const std::string& key) const {
    openvdb::initialize();
    openvdb::io::File file(at(name));
    file.open();
    return read(*file.getMetadata(), key);
}

} // namespace eikonal::volume
