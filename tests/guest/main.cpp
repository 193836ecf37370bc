#include <gtest/gtest.h>

#include "app/guest/guest.h"

int main(int count, char** arguments) {
  app::guest::run_if_guest(count, arguments);
  testing::InitGoogleTest(&count, arguments);
  return RUN_ALL_TESTS();
}
