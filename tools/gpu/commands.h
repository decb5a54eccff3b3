// Recording work and running it. Nothing waits for ever: a submission that takes longer than GpuOptions::timeout is an
// error, and after it, as after a lost device, the context takes no more work.
#pragma once

#include "gpu/bindings.h"
#include "gpu/pipeline.h"

#include <chrono>

namespace rigel::tools {

class GpuCommands {
 public:
  static constexpr int kMaxMarks = 64;

  static Result<GpuCommands> create(const GpuContext& context);

  /// Starts recording anew. What was submitted before must have been waited for.
  std::optional<Error> begin();

  void bind(const GpuPipeline& pipeline, const GpuBindings& bindings,
            std::span<const std::uint32_t> dynamicOffsets = {});
  /// After bind: all the layout's bytes.
  void push(std::span<const std::byte> constants);
  void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  /// What was written before is visible to all that follows.
  void barrier();
  /// The staged values into the texture.
  void upload(const Texture3d& texture);

  /// Drawing into a target: all of it, cleared (depth to 1). Clip space has y up and z from 0 to 1.
  void beginPass(const RasterTarget& target, std::span<const VkClearColorValue> clear);
  void bindVertices(std::uint32_t stream, const GpuBuffer& buffer, std::size_t offset = 0);
  void bindIndices(const GpuBuffer& buffer, std::size_t offset = 0);
  void draw(std::uint32_t vertices, std::uint32_t firstVertex = 0);
  void drawIndexed(std::uint32_t indices, std::uint32_t firstIndex = 0, std::int32_t vertexOffset = 0);
  void endPass();
  /// After a pass: an image of its target, row by row from the top, into a BufferUse::readBack.
  void read(const GpuImage& image, const GpuBuffer& to);

  /// A moment in the work, when all before it is done. Returns its number, from 0; at most kMaxMarks.
  int mark();

  std::optional<Error> submit();
  std::optional<Error> wait();
  /// Both.
  std::optional<Error> run();

  /// Between two marks, after wait(). Where the queue has no timestamps: from submit() to the end of wait(), whatever
  /// the marks (`hasTimestamps` tells).
  double seconds(int from, int to) const;
  bool hasTimestamps() const { return queries_ != VK_NULL_HANDLE; }

  GpuCommands(GpuCommands&& other) noexcept { swap(other); }
  GpuCommands& operator=(GpuCommands&& other) noexcept;
  ~GpuCommands();

  VkCommandBuffer handle() const { return buffer_; }

 private:
  GpuCommands() = default;
  void swap(GpuCommands& other) noexcept;
  std::optional<Error> createQueries();
  std::optional<Error> readMarks();
  std::optional<Error> failed(VkResult result);

  SharedDevice device_;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;  // of what is bound
  bool pending_ = false;
  int marks_ = 0;
  std::vector<std::uint64_t> times_;
  std::chrono::steady_clock::time_point submitted_;
  double wallSeconds_ = 0;
};

}  // namespace rigel::tools
