#include "renderer/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <memory>

namespace pluvia {
namespace {

std::unique_ptr<tbb::global_control>& thread_limit() {
    static std::unique_ptr<tbb::global_control> limit;
    return limit;
}

}  // namespace

void set_thread_count(int threads) {
    thread_limit().reset();
    if (threads > 0)
        thread_limit() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

int thread_count() {
    return int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for(int count, const std::function<void(int)>& body) {
    tbb::parallel_for(0, count, [&](int index) { body(index); });
}

void parallel_in_order(int count, const std::function<void(int)>& body) {
    std::atomic<int> next = 0;
    tbb::parallel_for(
        0, thread_count(),
        [&](int) {
            for (int index; (index = next.fetch_add(1)) < count;) {
                try {
                    body(index);
                } catch (...) {
                    next = count;  // the other workers stop at their next index
                    throw;
                }
            }
        },
        tbb::simple_partitioner());
}

void run_serially(const std::function<void()>& body) {
    tbb::task_arena(1).execute(body);
}

}  // namespace pluvia
