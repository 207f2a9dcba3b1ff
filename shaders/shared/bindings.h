// Where kernels find what they read and write; shaders/README.md is made from this. Read by C++ and
// GLSL.
// SPDX-License-Identifier: GPL-3.0-or-later

// Uniform blocks.
const int kParamsBlock = 0;    // what the kernel itself is told
const int kEmissionBlock = 1;  // plain.comp: EmissionParams
const int kTransportBlock = 2; // TransportParams
const int kFieldBlock = 3;     // FieldParams
const int kSceneBlock = 4;     // SceneParams
const int kSurfaceBlock = 5;   // SurfaceParams
const int kSpectrumBlock = 6;  // SpectrumParams
const int kGroundBlock = 7;    // GroundParams
const int kDomainsBlock = 8;   // DomainParams
const int kPlateBlock = 9;     // PlateParams

// Textures of the transport core.
const int kFieldUnit = 8;        // (½∇(n²) [1/voxel], n), or spline coefficients
const int kDispersedFieldUnit = 22; // the same at kDispersedTerm of field_params.h
const int kCrystalsUnit = 24;    // coefficients of crystals that vary: D_xx, D_yy, D_zz, n_o
const int kMixedCrystalsUnit = 25; // D_yz, D_zx, D_xy
const int kDistancesUnit = 9;    // spline coefficients of signed distances, by blocks of cells [voxel]
const int kClearanceUnit = 10;   // how far off any interface is at least [voxel]
const int kNearbyUnit = 11;      // the objects that hold a cube of voxels or are near it: bits, or which sets
const int kAbsorptionsUnit = 12; // coefficients that vary within regions [1/voxel], g
const int kScatteringsUnit = 13; // [1/voxel]
const int kEmissionsUnit = 14;   // [radiance/voxel]
const int kBlocksUnit = 15;      // where each object's blocks of cells lie among the distances
const int kSetsUnit = 16;        // of many objects: sets of those near a cube and of those that hold it
const int kVoxelBlocksUnit = 17; // where blocks of voxels lie in textures of them
const int kSurfaceTableUnit = 20;   // finds the records of voxels that have surface voxels
const int kSurfaceRecordsUnit = 21; // which of a voxel's fine ones those are, and their numbers

// view: textures of blurred media, of light, of what surrounds the scene.
const int kIrradianceUnit = 0;  // on opaque surfaces, by surface voxels' numbers [W/m²]
const int kExtinctionUnit = 1;  // σ_t, or with the source of a grey medium beside it [1/voxel]
const int kSourceUnit = 2;      // radiance gained per voxel of length
const int kDirectionUnit = 3;   // light_direction in voxel space, g
const int kEmissionUnit = 4;    // [radiance/voxel]
const int kOpacityUnit = 5;     // opacity, albedo
const int kFluenceUnit = 6;     // [W/m²]
const int kEnvironmentUnit = 7; // radiance
const int kPointPlacesUnit = 18; // of a picture whose points' light is known [voxel]
const int kPointLightsUnit = 19; // that light [W/m²]
const int kPlateUnit = 23;       // a picture behind the scene, radiance

// view: storage buffers.
const int kColoursBuffer = 0;    // premultiplied RGBA per pixel
const int kPixelPathsBuffer = 1; // PixelPath per pixel
const int kCountersBuffer = 2;   // see view_params.h
const int kRestsBuffer = 3;      // sharp: branches that go on in another launch
const int kDeparturesBuffer = 4; // Departure: rays on their way to another domain
const int kPendingBuffer = 5;    // of each pixel of a strip the first of those

// lightsim: textures.
const int kPhotonMapUnit = 0;  // where the light first meets the domain or the proxy [voxel]
const int kLeavesUnit = 2;     // the octree's leaf of every 2×2×2 voxels
const int kAbsorptionUnit = 3; // of blurred media, grey: (σ_a, σ_s) [1/voxel]
const int kScatteringUnit = 4; // [1/voxel]
const int kOpaqueUnit = 5;     // not 0 inside opaque voxels

// lightsim: storage buffers.
const int kCountBuffer = 0;    // photons on the next list; not 0 if a sum was near its end
const int kPhotonsBuffer = 1;  // one per pixel of the photon map
const int kListBuffer = 2;     // pixels whose photon goes on
const int kNextListBuffer = 3; // those of the next launch
const int kBricksBuffer = 4;   // where each brick of voxels lies in the atlases of sums
const int kPolarisationsBuffer = 5; // in scenes with crystals: each photon's mode and polarisation
const int kAimsBuffer = 6;     // of each tile of the photon map, not 0 if photons go there
const int kObjectsBuffer = 10; // of many objects: those that each photon is in
const int kEnergyBuffer = 2;   // energy.comp: what each work item summed up
const int kCornersBuffer = 0;  // map.vert: of the triangles that photons start on [voxel]
const int kBrickListBuffer = 0; // smooth.comp, plain.comp: the bricks that receive

// lightsim, beams and surfaces: a texture and storage buffers.
const int kOpacityFieldUnit = 6;     // of blurred media
const int kPointsBuffer = 0;         // BeamPoint
const int kParentsBuffer = 1;        // those of the generation before
const int kShiftedBuffer = 1;        // beam_sort.comp, beam_cut.comp, beam_deposit.comp: BeamPoint, of another wavelength
const int kBranchesBuffer = 2;       // of points at an interface, bits: the branches that they go on by
const int kNodesBuffer = 3;          // BeamNode
const int kBeamsBuffer = 4;          // nodes to be laid down
const int kSplitsBuffer = 5;         // nodes to be split
const int kNextNodesBuffer = 6;      // BeamNode: children, or those that go on from an interface
const int kCellsBuffer = 6;          // beam_cut.comp, beam_deposit.comp: cells of beams
const int kBeamCountsBuffer = 7;     // see beam_params.h
const int kBooksBuffer = 8;          // power by what became of it, fixed point
const int kWantedBuffer = 9;         // points that go on, each with its branch
const int kParentObjectsBuffer = 13; // of many objects: those that each parent is in
const int kSlotsBuffer = 14;         // of every point and branch: where it is in that list
const int kReceivingBuffer = 15;     // bricks of 8³ voxels that hold surface voxels, bits
const int kSurfaceSumsBuffer = 12;   // fixed-point sums of surface voxels, plane by plane
const int kVoxelListBuffer = 0;      // voxels of the domain to look at
const int kMasksBuffer = 1;          // which of their fine voxels opaque surfaces cross
const int kSurfacePointsBuffer = 0;  // points of surfaces that are asked for their light
const int kPointLightsBuffer = 1;    // what they get
const int kAreasBuffer = 2;          // of each surface voxel: area [face of a voxel], normal

// lightsim, wavefronts: storage buffers.
const int kFrontBeforeBuffer = 0;   // FrontCorner, four a patch, before a step
const int kFrontAfterBuffer = 9;    // and after it
const int kFrontPatchesBuffer = 1;  // FrontPatch
const int kFrontDepthsBuffer = 2;   // FrontDepth, of the corners of some thousand patches
const int kFrontHitsBuffer = 3;     // FrontHit of the same
const int kFrontBacksBuffer = 5;    // FrontBack, four a patch
const int kFrontEnergyBuffer = 6;    // FrontEnergy
const int kFrontCountersBuffer = 7; // see front_params.h
const int kFrontPlacesBuffer = 8;   // new patches that each patch makes; then how many are before them
const int kFrontCompactedBuffer = 11; // front_compact.comp: FrontPatch, of those that go on
const int kScanCountsBuffer = 0;    // scan.comp: counts, then what is before each
const int kScanSumsBuffer = 1;      // the same of runs of them

// lightsim: images of surface voxels, by rows.
const int kSurfacePowerImage = 4; // [W]
const int kIrradianceImage = 5;   // [W/m²]

// lightsim: images, atlases of bricks that receive (AtlasLayout in libcore/lightsim/voxels.h).
const int kPlanesImage = 0;   // fixed-point sums
const int kTotalsImage = 1;   // floats
const int kSmoothedImage = 2; // smooth.comp: floats after a pass

// Filters along an axis: storage buffers.
const int kSourceBuffer = 0;  // floats per voxel
const int kTargetBuffer = 1;  // floats per voxel
const int kWeightsBuffer = 2; // smooth: by offset

// voxelize: storage buffers.
const int kFacetsBuffer = 0;  // triangles
const int kChangesBuffer = 1; // of the count of sub-samples, per voxel

// imagespace: textures and storage buffers.
const int kFrontsUnit = 0;       // outward normals and depths of front faces, or layers of all, nearest first
const int kBacksUnit = 1;        // of the furthest back faces, with mip levels
const int kDistancesUnit2d = 2;  // isr: along the normal to the far side [unit]
const int kPlatesUnit = 3;       // of opaque meshes, as kFrontsUnit
const int kAlbedosUnit = 4;      // theirs
const int kColoursImage = 0;     // premultiplied RGBA per pixel
const int kPathsImage = 1;       // SurfacePath per pixel
const int kDepthRangeBuffer = 4; // bits of the least and the greatest depth of back faces
