#pragma once
// Errors of the public interface.

#include <gtest/gtest.h>

#include <string>

#include <sbcollide/error.h>

/// Fails the test unless work() throws a sbcollide::Error with this text.
void expect_error(const std::string& text, const auto& work) {
  try {
    work();
    ADD_FAILURE() << "no error: " << text;
  } catch (const sbcollide::Error& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}
