// The pages of ovoid view, check and run.
#ifndef OVOID_CLI_PAGE_SCENES_H
#define OVOID_CLI_PAGE_SCENES_H

#include "page/motion.h"
#include "pairs/answers.h"

/// Writes the page of a scene at rest: its objects, and the pairs of a job, the nearest first, each answered with its
/// proof. title: the scene's path. 0, or an exit code after a message. Does nothing if no page is wanted.
int page_write_scene(cli_page *page, const char *title, const answers_job *job);

/// One body or two that are not in a scene.
typedef struct page_bodies_source {
    const page_body *bodies; ///< mesh: the path of the file
    size_t count;
    const char *unit; ///< "" for none
    double margin;    ///< negative: none was given
} page_bodies_source;

/// Writes the page of one body, or of two with the answer of their pair. 0, or EXIT_INPUT after a message. Does nothing
/// if no page is wanted.
int page_write_files(cli_page *page, const page_bodies_source *source);

/// The results of a motion.
typedef struct page_run {
    page_motion *motion;
    cli_track *track; ///< with pairs
    double margin;    ///< of the events; negative: none
} page_run;

/// Writes the page of a moving scene: for each listed pair its answer in the frame of the page that is nearest to the
/// pair's nearest frame. job: without poses and couples. Otherwise as page_write_scene.
int page_write_run(cli_page *page, const char *title, const answers_job *job, const page_run *run);

#endif
