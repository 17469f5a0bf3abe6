# Ангар: процеси ArduPilot SITL.

hangar-unknown = екземпляра { $id } немає
hangar-taken = екземпляр { $id } вже є: спершу зупиніть його або виберіть інший номер
hangar-full = працює екземплярів: { $limit }, більше не можна: зупиніть якісь або підніміть межу
hangar-no-program = { $program } не знайдено: назвіть його через --arducopter чи SORTIE_ARDUCOPTER або додайте до PATH
hangar-attached = до екземпляра { $id } вже хтось під'єднаний
hangar-host = не вдається запустити екземпляр { $id }: { $what }: { $error }
hangar-closing = ангар закривається
hangar-cannot-open = не вдалося відкрити ангар у { $folder }: { $error }
hangar-no-service = служба ангара за адресою { $urls } поки недоступна
