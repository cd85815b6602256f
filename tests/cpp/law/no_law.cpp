/// A shared library without a law.

extern "C" [[gnu::visibility("default")]] int tissu_test_no_law() { return 0; }
