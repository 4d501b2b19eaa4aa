#pragma once

#include <filesystem>
#include <string>

/// Top of the repository that the tests were built from.
const std::filesystem::path& source_directory();

/// The program that was built with the tests.
const std::string& rollres_program();

/// Whether the libraries under test were built with the address sanitizer, which takes all addresses and more memory.
bool address_sanitizer();

/// How much of a random input a test tries: `amount`, or with ROLLRES_THIN in the environment a tenth, one at least.
int thinned(int amount);

/// Processor time that a test allows [s]: with ROLLRES_THIN, and so under sanitizers, twenty times as much.
double patience(double seconds);

/// A file of studies/examples.
std::string example(const std::string& name);
