// The one place that starts parallel work (TBB behind it).
#pragma once

#include <functional>

namespace pluvia {

/// Number of threads that parallel_for uses; 0 = all the process may use. Call once, before any parallel work.
void set_thread_count(int threads);
int thread_count();

/// Calls body(index) for 0 <= index < count, in any order and at the same time. An exception in a body stops the rest
/// and is thrown again here.
void parallel_for(int count, const std::function<void(int index)>& body);

/// Like parallel_for, but indices are handed out one by one in rising order, so that results which must leave in
/// order wait for few others.
void parallel_in_order(int count, const std::function<void(int index)>& body);

/// Runs body with parallel work inside it confined to one thread, for libraries whose result depends on the split.
void run_serially(const std::function<void()>& body);

}  // namespace pluvia
