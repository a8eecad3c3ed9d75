// Boots: without arguments the window, with a command the headless command line.
#include "app/cli/cli.h"

int main(int argc, char** argv) {
  return sinew::runCli(argc, argv, {});
}
