// What the writers and the reader of results share.
#ifndef OVOID_IO_RESULTS_RECORD_H
#define OVOID_IO_RESULTS_RECORD_H

#include <ovoid/io.h>

/// 1 for a record of an impact, 0 for one of a frame.
int record_is_impact(const ovoid_record *record);

/// 1 where the record has a margin.
int record_has_margin(const ovoid_record *record);

/// What the bracket says of the record's margin: "yes" (within), "no" (farther), "at" (the bracket is as narrow as
/// asked and holds the margin) or "unproven"; "" without a margin.
const char *record_find_within(const ovoid_record *record);

#endif
