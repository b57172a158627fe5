// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace orbslam {

/// Calls work(i) once for every i in [0, count), on up to num_threads threads, and returns when all are done.
/// Who gets which i is left to chance: work must write only what belongs to its i.
void ParallelFor(size_t count, int num_threads, const std::function<void(size_t)>& work);

}  // namespace orbslam
