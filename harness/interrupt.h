#pragma once

namespace conebench::harness {

/// Makes SIGINT and SIGTERM set a flag instead of ending the process; the loops look at it.
void catch_interrupts();

/// True once one of them arrived.
bool interrupted();

/// The exit code of an interrupted command: what is done is kept, and a later call goes on.
inline constexpr int kInterruptedExit = 130;

}  // namespace conebench::harness
