// The kernels of disk_batch.cpp and disk_batch_irradiance.cpp, for other kernels of the same Highway target. Included once per target.
#if defined(RIGEL_DISK_BATCH_KERNELS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_DISK_BATCH_KERNELS_H
#undef RIGEL_DISK_BATCH_KERNELS_H
#else
#define RIGEL_DISK_BATCH_KERNELS_H
#endif

namespace rigel::HWY_NAMESPACE {

/// As projectDiskBatch; `light` shines.
void projectDiskPoints(const DiskBatchLight& light, const Vec3Rows& points, int bands, int nodes, float* sh);

/// Irradiance per unit radiance at a block's points, a whole number of vectors.
void diskIrradianceBlock(const DiskBatchLight& light, const SurfaceRows& surface, std::size_t points,
                         const NearWrap& wrap, float* irradiance);

}  // namespace rigel::HWY_NAMESPACE
#endif
