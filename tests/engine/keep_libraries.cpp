// Keeps all libraries loaded, for the leak check of the address sanitizer: memory that a graphics driver keeps until
// the process ends would count as leaked after the driver is unloaded.

extern "C" int dlclose(void*) { return 0; }
