// SPDX-License-Identifier: Apache-2.0
/** `tautline-mpi`: `tautline sweep` over the ranks of an MPI program. Rank 0 hands out runs, the others do them, each
in a process of its own: `mpirun -n 64 tautline-mpi MODEL SWEEP --out FOLDER`, the folder on a disk that all ranks see.
*/
#include <mpi.h>

#include <cstdlib>
#include <iostream>

#include "sweep/local_pool.h"
#include "sweep/sweep_command.h"
#include "sweep_mpi/rank_pool.h"
#include "tautline/version.h"

namespace tautline {
namespace {

/** How a rank has ended. */
struct Ending {
    int exitCode = 1;
    bool isWhole = true;  ///< no rank was lost
};

Ending handOut(const SweepCommand& sweep, const SweepPlan& plan, double patience) {
    RankPool pool(std::chrono::milliseconds(static_cast<long>(1000 * patience)));
    Ending ending;
    try {
        ending.exitCode = sweep.run(plan, pool, std::cout, false);
    } catch (const std::exception& error) {
        std::cerr << "tautline-mpi: " << error.what() << "\n";
    }
    ending.isWhole = pool.dismiss();
    return ending;
}

Ending serve(const SweepCommand& sweep, const SweepPlan& plan) {
    LocalPool pool(plan, sweep.modelFile, sweep.outFolder, 1);
    return {0, serveRuns(pool)};
}

Ending runRank(int rank, int argc, char** argv) {
    CLI::App app{"Tautline: tautline sweep over the ranks of mpirun"};
    app.set_version_flag("--version", "tautline-mpi " TAUTLINE_VERSION);
    SweepCommand sweep;
    sweep.declare(app);
    app.remove_option(app.get_option("--jobs"));
    double patience = 60;
    app.add_option("--lost-after", patience, "time after which a silent rank counts as lost [s]")
        ->check(CLI::Range(0.5, 1e6))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
        const SweepPlan plan = sweep.readPlan();
        return rank == 0 ? handOut(sweep, plan, patience) : serve(sweep, plan);
    } catch (const CLI::ParseError& error) {
        return {rank == 0 ? app.exit(error) : error.get_exit_code(), true};
    } catch (const std::exception& error) {
        if (rank == 0) std::cerr << "tautline-mpi: " << error.what() << "\n";
        return {};
    }
}

}  // namespace
}  // namespace tautline

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const tautline::Ending ending = tautline::runRank(rank, argc, argv);
    std::cout << std::flush;
    if (!ending.isWhole) std::_Exit(ending.exitCode);
    MPI_Finalize();
    return ending.exitCode;
}
