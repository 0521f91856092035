#include "engine/bucket_queue.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace tessera {

void render_buckets(const FrameParts& parts, int threads, BucketQueue& queue,
                    FrameStatistics& statistics) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::task_group workers;
    for (int k = 0; k < threads; ++k) {
      workers.run([&] {
        BucketRenderer renderer(parts);
        try {
          for (int i, j; queue.take(i, j); queue.done()) renderer.render(i, j);
        } catch (...) {
          queue.stop();
          throw;
        }
        statistics.add(renderer);
      });
    }
    workers.wait();
  });
}

}  // namespace tessera
