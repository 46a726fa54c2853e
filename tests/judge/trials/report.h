// A failure in words and numbers: the pair and the answer, with every bit, so that it can be seen again.
#ifndef OVOID_TRIALS_REPORT_H
#define OVOID_TRIALS_REPORT_H

#include "ovoid/ovoid.h"

#include <stdio.h>

void print_pair(FILE *f, const ovoid_pair *pair);
void print_answer(FILE *f, const ovoid_answer *x);

#endif
