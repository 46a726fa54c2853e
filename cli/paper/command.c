// ovoid paper: the paper's experiment, repeated; writes a folder of numbers and figures, and a page of all results.
#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"
#include "commands.h"
#include "paper/experiment.h"

#include <stdlib.h>
#include <string.h>

typedef struct settings {
    const char *output;
    unsigned frames, seed;
} settings;

static const cli_option options[] = {
    {"out", 'o', OPTION_FILE, offsetof(settings, output), "DIR", NULL,
     "the folder of the report; made if it is not there, files of the same names are replaced"},
    {"frames", 0, OPTION_COUNT, offsetof(settings, frames), "N", NULL,
     "frames of the moving box, for each of the other 30 models; all other samples grow with it (default: 240)"},
    {"seed", 0, OPTION_COUNT, offsetof(settings, seed), "N", NULL,
     "seed of everything that is random; the same seed gives the same counts and shares (default: 1)"},
    {0},
};

static const struct part {
    const char *name;
    void (*add)(const experiment *e);
} parts[] = {
    {"models", experiment_add_models},
    {"times", experiment_add_times},
    {"faces", experiment_add_faces},
    {"soundness", experiment_add_soundness},
    {"propositions", experiment_add_propositions},
    {"accuracy", experiment_add_accuracy},
    {"bracket", experiment_add_bracket},
    {"phases", experiment_add_phases},
    {"changes", experiment_add_changes},
    {"arm", experiment_add_arm},
};
#define PART_COUNT (sizeof parts / sizeof *parts)

static void add_head(const experiment *e) {
    report_add_section(e->report, "Enclosed ellipsoids and facial area splitting, repeated");
    report_add_text(
        e->report,
        "W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method Based on Enclosed Ellipsoid by "
        "Facial Areas Splitting: every system, table and chart of the paper, made again by one command. Under "
        "each figure stands what the paper says, what was measured in this run, and why the two differ. All "
        "numbers come from this run; counts and shares are the same for the same seed (here %llu) and number of "
        "frames (here %u), times are medians of this machine and to be read as ratios.",
        (unsigned long long)e->seed, e->frames);
}

static int run_experiment(experiment *e, const settings *s) {
    int code = 0;
    progress_start("parts", PART_COUNT);
    for (size_t i = 0; i < PART_COUNT && report_is_good(e->report); i++) {
        progress_set(i);
        parts[i].add(e);
    }
    progress_end();
    ovoid_error error = {0};
    if (report_finish(e->report, &error) != OVOID_OK) {
        message_error("%s", error.message);
        code = EXIT_INPUT;
    } else
        message_note("wrote %s%sreport.html", s->output, s->output[strlen(s->output) - 1] == '/' ? "" : "/");
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.frames = 240, .seed = 1};
    cli_operands none;
    int code = command_parse(command, argc, argv, &s, &none);
    if (code >= 0) return code;
    if (!s.output || !*s.output) return args_complain(command, "paper: --out DIR is missing");
    experiment e = {.frames = s.frames, .seed = s.seed, .report = report_create(s.output)};
    e.models = e.report ? paper_models_create() : NULL;
    if (e.models) {
        add_head(&e);
        code = run_experiment(&e, &s);
    } else {
        message_error("out of memory");
        if (e.report) (void)report_finish(e.report, NULL);
        code = EXIT_INPUT;
    }
    paper_models_destroy(e.models);
    return code;
}

const cli_command command_paper = {
    .name = "paper",
    .summary = "the experiment of the paper behind ovoid, repeated",
    .usage = "[OPTION...] --out DIR",
    .description =
        "Repeats the experiment of \"Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial "
        "Areas Splitting\" (Su, Liu, Chen): the models, the time of each step, facial areas against checking all "
        "faces, the soundness of its rules, false alarms and misses, the bracket, the three phases, bodies that "
        "are deformed or divided, an arm of links. Writes CSV files, SVG figures and report.html, a page that "
        "holds all of them, which of the paper's claims hold first. Takes some seconds, in proportion to --frames.",
    .exits = "0 written\n"
             "2 the command line is wrong\n"
             "3 the folder or a file could not be written",
    .examples = "ovoid paper --out report\n"
                "ovoid paper --out report --frames 1000 --seed 7",
    .options = options,
    .operands_min = 0,
    .operands_max = 0,
    .run = run,
};
