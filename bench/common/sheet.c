// A sheet is an SVG whose parts are the charts' own elements, moved.
#include "common/sheet.h"

#include <stdio.h>

int sheet_write(const char *path, const ovoid_chart *charts, uint32_t count, uint32_t columns, const char *caption) {
    if (count == 0) return 0;
    FILE *file = fopen(path, "w");
    if (!file) return 0;
    uint32_t rows = (count + columns - 1) / columns, width = columns * charts->width,
             height = rows * charts->height + 24;
    (void)fprintf(file, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%u\" height=\"%u\" viewBox=\"0 0 %u %u\">\n",
                  width, height, width, height);
    (void)fprintf(file, "<rect width=\"%u\" height=\"%u\" fill=\"#fff\"/>\n", width, height);
    int good = 1;
    for (uint32_t i = 0; i < count; i++) {
        (void)fprintf(file, "<g transform=\"translate(%u %u)\">\n", i % columns * charts->width,
                      i / columns * charts->height);
        good &= ovoid_chart_write_svg(file, &charts[i]) == OVOID_OK;
        (void)fprintf(file, "</g>\n");
    }
    (void)fprintf(file, "<text x=\"12\" y=\"%u\" font-family=\"sans-serif\" font-size=\"11\">%s</text>\n</svg>\n",
                  height - 8, caption);
    return fclose(file) == 0 && good;
}
