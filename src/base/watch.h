// Asks the host whether a call may go on.
#ifndef OVOID_BASE_WATCH_H
#define OVOID_BASE_WATCH_H

#include "ovoid/base.h"

/// 1 if the host wants the call to end. NULL: never.
static inline int watch_is_stopped(const ovoid_watch *watch) {
    return watch && watch->is_stopped && watch->is_stopped(watch->context);
}

#endif
