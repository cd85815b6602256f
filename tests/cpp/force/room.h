#pragma once

#include "tissu/force/scratch.h"

namespace tissu::test {

/// The room that models work in when a test calls them: one for each thread.
inline Scratch& scratch() {
  thread_local Scratch room;
  return room;
}

}  // namespace tissu::test
