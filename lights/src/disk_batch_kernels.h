// The kernels of disk_batch.cpp, for other kernels of the same Highway target. Included once per target.
#if defined(RIGEL_DISK_BATCH_KERNELS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_DISK_BATCH_KERNELS_H
#undef RIGEL_DISK_BATCH_KERNELS_H
#else
#define RIGEL_DISK_BATCH_KERNELS_H
#endif

namespace rigel::HWY_NAMESPACE {

/// As projectDiskBatch; `light` shines.
void projectDiskPoints(const DiskBatchLight& light, const Vec3Rows& points, int bands, int nodes, float* sh);

}  // namespace rigel::HWY_NAMESPACE
#endif
