#pragma once
/// Types of parameters: the standard ones, those of Declare, and inline declarations.

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "scenes/parameter.h"

namespace tessera {

struct Declaration {
  StorageClass storage = StorageClass::uniform;
  ValueType type = ValueType::scalar;
  int array_size = 1;
};

class Declarations {
 public:
  /// Starts with the standard parameters of the RenderMan Interface and of this renderer.
  Declarations();

  /// Declare "name" "[class] type [\"[n]\"]". Throws Error at `where` when that is no declaration.
  void declare(const std::string& name, const std::string& declaration,
               const SourceLocation& where);

  struct Resolved {
    std::string name;
    std::optional<Declaration> declaration;  ///< nothing: nobody declared it
  };
  /// The name and type of a parameter token, which is a name or "[class] type [\"[n]\"] name".
  Resolved resolve(const std::string& token, const SourceLocation& where) const;

 private:
  std::map<std::string, Declaration, std::less<>> declared_;
};

}  // namespace tessera
