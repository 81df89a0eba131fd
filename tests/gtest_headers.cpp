// Nothing of its own: the program whose precompiled headers the test programs use.
