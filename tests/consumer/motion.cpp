// SPDX-License-Identifier: GPL-3.0-or-later
// motion DEVICE.xml [DATA_DIRECTORY]: the same in C++17: a design that frees itself, errors as exceptions,
// a column as a view.
#include <flexwright.h>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

namespace {

struct Free {
    void operator()(fw_design *design) const {
        fw_design_free(design);
    }
};
using Design = std::unique_ptr<fw_design, Free>;

void check(const Design &design, int status) {
    if (status == FW_STATUS_OK) return;
    std::string text = fw_status_name(status);
    for (size_t i = 0; i < fw_design_diagnostics(design.get()); i++) {
        const fw_diagnostic *d = fw_design_diagnostic(design.get(), i);
        text += std::string("\n") + (d->file ? d->file : "") + ":" + std::to_string(d->line) + ":" +
                std::to_string(d->column) + ": " + d->message;
    }
    throw std::runtime_error(text);
}

// of rows x hinges
double largest(const fw_array &angle, size_t hinge) {
    const auto *value = static_cast<const double *>(angle.data);
    double most = 0;
    for (size_t i = 0; i < angle.extent[0]; i++)
        most = std::fmax(most, std::fabs(value[i * angle.extent[1] + hinge]));
    return most;
}

} // namespace

int main(int argc, char **argv) try {
    if (argc < 2 || argc > 3) {
        std::cerr << "usage: motion DEVICE.xml [DATA_DIRECTORY]\n";
        return 99;
    }
    fw_design_options options = fw_design_options_default();
    if (argc > 2) options.data_directory = argv[2];
    Design design(fw_design_new(&options));
    check(design, fw_design_set(design.get(), "arc", "230 deg"));
    check(design, fw_design_read(design.get(), argv[1]));
    check(design, fw_design_simulate(design.get()));
    const fw_array *angle = fw_design_array_named(design.get(), FW_NUMBERS_MOTION, "angle");
    if (!angle) return 98;
    for (size_t k = 0; k < angle->extent[1]; k++)
        std::cout << "hinge " << angle->label[1][k] << ": " << largest(*angle, k) << " " << angle->unit
                  << "\n";
    return 0;
} catch (const std::exception &error) {
    std::cerr << error.what() << "\n";
    return 1;
}
