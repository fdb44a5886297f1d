/* Prints the merit that fclib computes for a contact problem and its solution; it is 0 for an exact solution.
 *
 *     cc fclib_merit.c -o fclib_merit $(pkg-config --cflags --libs fclib)
 *     ./fclib_merit pile/pile.hdf5
 *
 * The exit status is 1 if the merit is over 1e-12.
 */
#include <fclib.h>
#include <stdio.h>

int main(int arguments, char **argument)
{
    if (arguments != 2) {
        fprintf(stderr, "usage: fclib_merit FILE\n");
        return 2;
    }
    struct fclib_local *problem = fclib_read_local(argument[1]);
    struct fclib_solution *solution = problem ? fclib_read_solution(argument[1]) : NULL;
    if (!solution) {
        return 2;
    }
    double merit = fclib_merit_local(problem, MERIT_1, solution);
    printf("%d contacts, merit %.1e\n", problem->W->m / problem->spacedim, merit);
    /* A NaN is an error too. */
    return !(merit <= 1e-12);
}
