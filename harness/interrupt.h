#pragma once

namespace conebench::harness {

/// From now on SIGINT and SIGTERM set a flag instead of ending the process; run_pool() looks at it.
void catch_interrupts();

/// True once one of them arrived.
bool interrupted();

/// The exit code of an interrupted command: what is done is kept, and a later call goes on.
inline constexpr int kInterruptedExit = 130;

}  // namespace conebench::harness
