extern "C" int write_a_picture(const char* path);

int main() {
  return write_a_picture("x.png");
}
