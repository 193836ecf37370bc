#include "app/base/signals.h"

#include <semaphore.h>

#include <csignal>
#include <thread>

namespace app {
namespace {

sem_t arrived;
volatile std::sig_atomic_t signal_number = 0;

extern "C" void note_signal(int number) {
  signal_number = number;
  ::sem_post(&arrived);
}

/// Runs in a thread of its own, because a signal handler itself may call almost nothing.
void await_signal(void (*before_end)()) {
  while (::sem_wait(&arrived) != 0) continue;
  before_end();
  std::signal(signal_number, SIG_DFL);
  ::raise(signal_number);
}

}  // namespace

void handle_signals(void (*before_end)()) {
  ::sem_init(&arrived, 0, 0);
  std::thread(await_signal, before_end).detach();
  struct sigaction action {};
  action.sa_handler = &note_signal;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU}) {
    struct sigaction before {};
    ::sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(number, &action, nullptr);
  }
  for (const int number : {SIGXFSZ, SIGPIPE}) std::signal(number, SIG_IGN);
}

}  // namespace app
