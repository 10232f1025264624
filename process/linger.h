#pragma once

#include <functional>

namespace reprise::process {

/// Looks again and again until `there` says so, for `longest` [s] at most, and only as long as
/// nobody else gets the processor meanwhile; not at all where this process may keep one busy only.
/// For a thread that another one of ours is about to need: to wake who sleeps takes tens of
/// microseconds, part of them from who wakes him. It decides how one waits, never what happens.
void linger(double longest, const std::function<bool()>& there);

}  // namespace reprise::process
