// SPDX-License-Identifier: MIT
// A libEGL.so.1 whose functions exist and always fail.
extern "C" {
void* eglGetProcAddress(const char*) {
  return nullptr;
}
const char* eglQueryString(void*, int) {
  return nullptr;
}
int eglGetError() {
  return 0x3001;
}  // EGL_NOT_INITIALIZED
void* eglGetDisplay(void*) {
  return nullptr;
}
unsigned eglInitialize(void*, int*, int*) {
  return 0;
}
unsigned eglTerminate(void*) {
  return 0;
}
unsigned eglBindAPI(unsigned) {
  return 0;
}
unsigned eglQueryAPI() {
  return 0;
}
unsigned eglChooseConfig(void*, const int*, void**, int, int*) {
  return 0;
}
void* eglCreateContext(void*, void*, void*, const int*) {
  return nullptr;
}
unsigned eglDestroyContext(void*, void*) {
  return 0;
}
unsigned eglMakeCurrent(void*, void*, void*, void*) {
  return 0;
}
unsigned eglQueryContext(void*, void*, int, int*) {
  return 0;
}
void* eglGetCurrentContext() {
  return nullptr;
}
void* eglGetCurrentDisplay() {
  return nullptr;
}
void* eglGetCurrentSurface(int) {
  return nullptr;
}
}
